#include "sim/elastic/soft.h"

#include <utility>

namespace tumble {
namespace {

/// Calls act(i, j, k) for every cell, or with `past` for every point.
template <class Act>
void forGrid(const SoftDef& soft, int past, Act act) {
  for (int k = 0; k < soft.cells[2] + past; ++k)
    for (int j = 0; j < soft.cells[1] + past; ++j)
      for (int i = 0; i < soft.cells[0] + past; ++i) act(i, j, k);
}

/// Corners of a cell are numbered by bits: 1 along x, 2 along y, 4 along z. One tetrahedron in the
/// middle has every other corner, four cut off the rest.
constexpr int kCut[5][4] = {{0, 3, 5, 6}, {1, 3, 0, 5}, {2, 0, 3, 6}, {4, 5, 0, 6}, {7, 6, 3, 5}};

Energy energyOf(const SoftDef& soft, const Cell& cell) {
  if (soft.law == SoftLaw::Corotated) return Corotated{cell, soft.solid};
  return NeoHookean{cell, soft.solid};
}

std::vector<Element> matchingElements(const SoftDef& soft, int first) {
  const Vec3 cells(soft.cells[0], soft.cells[1], soft.cells[2]);
  const ShapeMatch match{.half = 0.5 * soft.size.cwiseQuotient(cells),
                         .mu = soft.solid.mu,
                         .viscosity = soft.solid.viscosity};
  std::vector<Element> elements;
  forGrid(soft, 0, [&](int i, int j, int k) {
    Element& cell = elements.emplace_back(Element{.points = {}, .count = 8, .energy = match});
    for (int c = 0; c < 8; ++c)
      cell.points[c] = first + softPoint(soft, i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
  });
  return elements;
}

}  // namespace

int softPoints(const SoftDef& soft) {
  return (soft.cells[0] + 1) * (soft.cells[1] + 1) * (soft.cells[2] + 1);
}

std::vector<Vec3> softPlaces(const SoftDef& soft) {
  std::vector<Vec3> places;
  const auto at = [&](int axis, int n) {
    return (n - 0.5 * soft.cells[axis]) * (soft.size[axis] / soft.cells[axis]);
  };
  forGrid(soft, 1, [&](int i, int j, int k) { places.emplace_back(at(0, i), at(1, j), at(2, k)); });
  return places;
}

std::vector<double> softMasses(const SoftDef& soft) {
  const bool even = soft.law == SoftLaw::Lattice || soft.law == SoftLaw::Matching;
  const double cell =
      soft.density * soft.size.prod() / (soft.cells[0] * soft.cells[1] * soft.cells[2]);
  std::vector<double> masses(softPoints(soft), 0.0);
  forGrid(soft, 0, [&](int i, int j, int k) {
    for (int c = 0; c < 8; ++c) {
      const std::array<int, 3> at = {i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)};
      // Neighbours are mirrored: corners of tetrahedra in the middle are those of even sum.
      const bool inMiddle = (at[0] + at[1] + at[2]) % 2 == 0;
      masses[softPoint(soft, at[0], at[1], at[2])] += cell / (even ? 8.0 : inMiddle ? 6.0 : 12.0);
    }
  });
  return masses;
}

std::vector<Element> softElements(const SoftDef& soft, int first) {
  if (soft.law == SoftLaw::Lattice) return latticeElements(soft, first);
  if (soft.law == SoftLaw::Matching) return matchingElements(soft, first);
  const std::vector<Vec3> places = softPlaces(soft);
  std::vector<Element> elements;
  forGrid(soft, 0, [&](int i, int j, int k) {
    const bool mirrored = (i + j + k) % 2 == 1;
    for (const auto& cut : kCut) {
      std::array<int, kElementPoints> p = {};
      for (int n = 0; n < 4; ++n) {
        const int c = mirrored ? cut[n] ^ 1 : cut[n];
        p[n] = softPoint(soft, i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
      }
      std::array<Vec3, 4> x;
      for (int n = 0; n < 4; ++n) x[n] = places[p[n]];
      if ((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) < 0.0) {
        std::swap(p[0], p[1]);
        std::swap(x[0], x[1]);
      }
      for (int n = 0; n < 4; ++n) p[n] += first;
      elements.push_back({.points = p, .count = 4, .energy = energyOf(soft, cellOf(x))});
    }
  });
  return elements;
}

std::vector<SoftFace> softFaces(const SoftDef& soft) {
  std::vector<SoftFace> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const int end : {0, 1}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (int n = 0; n < soft.cells[v]; ++n)
        for (int m = 0; m < soft.cells[u]; ++m) {
          const auto at = [&](int du, int dv) {
            std::array<int, 3> g = {};
            g[axis] = end * soft.cells[axis];
            g[u] = m + du;
            g[v] = n + dv;
            return softPoint(soft, g[0], g[1], g[2]);
          };
          // From outside u × v points along the axis.
          std::array<int, 3> p = {at(0, 0), at(1, 0), at(1, 1)}, q = {at(0, 0), at(1, 1), at(0, 1)};
          if (end == 0) {
            std::swap(p[1], p[2]);
            std::swap(q[1], q[2]);
          }
          faces.push_back({p, 2 * axis + end});
          faces.push_back({q, 2 * axis + end});
        }
    }
  return faces;
}

}  // namespace tumble
