#include "sim/elastic/strand.h"

namespace tumble {

std::vector<Vec3> strandPlaces(const StrandDef& strand) {
  const double piece = strand.length / strandPieces(strand);
  std::vector<Vec3> places;
  for (int k = 0; k < strand.points; ++k) places.emplace_back(0.0, (k - 1) * piece, 0.0);
  return places;
}

std::vector<double> strandMasses(const StrandDef& strand) {
  const double piece = strand.density * strand.length / strandPieces(strand);
  std::vector<double> masses(static_cast<std::size_t>(strand.points), piece);
  masses[0] = masses[1] = 0.25 * piece;
  masses.back() = 0.5 * piece;
  return masses;
}

std::vector<Element> strandElements(const StrandDef& strand, int first) {
  const double piece = strand.length / strandPieces(strand);
  std::vector<Element> elements;
  const auto add = [&](const std::array<int, kElementPoints>& points, const Energy& energy) {
    elements.push_back({.points = points, .count = pointsOf(energy), .energy = energy});
  };
  for (int k = 1; k + 1 < strand.points; ++k)
    add({first + k, first + k + 1},
        StretchSpring{
            .stiffness = strand.stretch / piece, .damping = strand.damping / piece, .rest = piece});
  if (strand.bend <= 0.0) return elements;
  for (int k = 1; k + 1 < strand.points; ++k)
    add({first + k - 1, first + k, first + k + 1},
        StrandBend{.stiffness = strand.bend, .length = k == 1 ? 0.5 * piece : piece});
  return elements;
}

}  // namespace tumble
