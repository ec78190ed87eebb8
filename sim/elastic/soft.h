// Chapter 2, elastic: a soft box as points and tetrahedra.
#pragma once

#include <array>
#include <vector>

#include "sim/elastic/elastic_body.h"

namespace tumble {

enum class SoftLaw { Corotated, NeoHookean };

/// A box that bends, in its own frame: edges along the axes, its middle at the origin.
struct SoftDef {
  std::array<int, 3> cells = {1, 1, 1};
  Vec3 size = Vec3::Ones();  ///< [m] full edges
  double density = 1000.0;   ///< [kg/m³]
  SoftLaw law = SoftLaw::Corotated;
  Solidity solid;
};

int softPoints(const SoftDef& soft);
inline int softPoint(const SoftDef& soft, int i, int j, int k) {
  return i + (soft.cells[0] + 1) * (j + (soft.cells[1] + 1) * k);
}

/// Places of the points at rest, in the box's frame [m].
std::vector<Vec3> softPlaces(const SoftDef& soft);

/// Masses [kg] of the points: of each cell a sixth for the corners of the tetrahedron in its
/// middle, a twelfth for the others. As these share an even stress of the cell – a third of each
/// side hangs on both ends of its diagonal, a sixth on its other corners – a weight that is even is
/// carried by stresses that are even in every cell, and a bar that hangs lengthens as a row of
/// springs.
std::vector<double> softMasses(const SoftDef& soft);

/// Its energies, by numbers of points plus `first`: five tetrahedra a cell, those of neighbours
/// mirrored, so that a box of even numbers of cells is as symmetric as it looks.
std::vector<Element> softElements(const SoftDef& soft, int first = 0);

/// A triangle of the surface, counter-clockwise from outside, and which of the six sides it is on.
struct SoftFace {
  std::array<int, 3> points;
  int side = 0;
};
std::vector<SoftFace> softFaces(const SoftDef& soft);

}  // namespace tumble
