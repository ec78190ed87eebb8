// A soft box as a lattice of springs.
#include <algorithm>
#include <map>
#include <utility>

#include "sim/elastic/soft.h"

namespace tumble {
namespace {

/// Edges of a cell [m].
Vec3 cellSize(const SoftDef& soft) {
  return soft.size.cwiseQuotient(Vec3(soft.cells[0], soft.cells[1], soft.cells[2]));
}

double edgeStiffness(const SoftDef& soft, int axis) {
  const Vec3 edge = cellSize(soft), square = edge.cwiseProduct(edge);
  const double a = square[axis], b = square[(axis + 1) % 3], c = square[(axis + 2) % 3];
  return soft.solid.mu * edge.prod() * (3.0 - a / b - a / c) / a;
}

double diagonalStiffness(const SoftDef& soft, int across) {
  const Vec3 edge = cellSize(soft), square = edge.cwiseProduct(edge);
  const double a = square[(across + 1) % 3], b = square[(across + 2) % 3];
  return soft.solid.mu * edge.prod() * (a + b) / (2.0 * a * b);
}

/// Corners of a cell are numbered by bits: 1 along x, 2 along y, 4 along z.
struct CellSpring {
  int from, to;
  double stiffness;  ///< [N/m] the part of one cell
};

/// Four cells share an edge, two share the diagonals of a side.
std::vector<CellSpring> springsOfCell(const SoftDef& soft) {
  std::vector<CellSpring> springs;
  for (int axis = 0; axis < 3; ++axis) {
    const int along = 1 << axis, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
    for (const int corner : {0, u, v, u | v})
      springs.push_back({corner, corner | along, 0.25 * edgeStiffness(soft, axis)});
    for (const int side : {0, along}) {
      springs.push_back({side, side | u | v, 0.5 * diagonalStiffness(soft, axis)});
      springs.push_back({side | u, side | v, 0.5 * diagonalStiffness(soft, axis)});
    }
  }
  return springs;
}

}  // namespace

bool hasLattice(const SoftDef& soft) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(edgeStiffness(soft, axis) >= 0.0)) return false;
  return true;
}

std::vector<Element> latticeElements(const SoftDef& soft, int first) {
  std::map<std::pair<int, int>, double> stiffness;
  const std::vector<CellSpring> springs = springsOfCell(soft);
  for (int k = 0; k < soft.cells[2]; ++k)
    for (int j = 0; j < soft.cells[1]; ++j)
      for (int i = 0; i < soft.cells[0]; ++i) {
        const auto at = [&](int c) {
          return softPoint(soft, i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
        };
        for (const CellSpring& spring : springs)
          stiffness[std::minmax(at(spring.from), at(spring.to))] += spring.stiffness;
      }
  const std::vector<Vec3> places = softPlaces(soft);
  std::vector<Element> elements;
  for (const auto& [ends, k] : stiffness) {
    const auto [p, q] = ends;
    elements.push_back({.points = {first + p, first + q},
                        .count = 2,
                        .energy = StretchSpring{.stiffness = k,
                                                .damping = k * soft.solid.viscosity / soft.solid.mu,
                                                .rest = (places[p] - places[q]).norm()}});
  }
  return elements;
}

}  // namespace tumble
