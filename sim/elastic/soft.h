// Chapter 2, elastic: a soft box as points and tetrahedra.
#pragma once

#include <array>
#include <vector>

#include "sim/elastic/elastic_body.h"

namespace tumble {

/// Corotated and neo-Hookean solids are tetrahedra, a lattice is springs along the edges of the
/// cells and the diagonals of their sides, cells that match are drawn to their shape as a whole.
enum class SoftLaw { Corotated, NeoHookean, Lattice, Matching };

/// A box that bends, in its own frame: edges along the axes, its middle at the origin.
struct SoftDef {
  std::array<int, 3> cells = {1, 1, 1};
  Vec3 size = Vec3::Ones();  ///< [m] full edges
  double density = 1000.0;   ///< [kg/m³]
  SoftLaw law = SoftLaw::Corotated;
  Solidity solid;  ///< of a lattice: λ = μ, for its springs pull along themselves alone; of cells
                   ///< that match: λ = 0
};

int softPoints(const SoftDef& soft);
inline int softPoint(const SoftDef& soft, int i, int j, int k) {
  return i + (soft.cells[0] + 1) * (j + (soft.cells[1] + 1) * k);
}

/// Places of the points at rest, in the box's frame [m].
std::vector<Vec3> softPlaces(const SoftDef& soft);

/// Masses [kg] of the points: an eighth of each cell of a lattice or that matches; of other cells a
/// sixth for the corners of the tetrahedron in its middle, a twelfth for the others. As these share
/// an even stress of the cell – a third of each side hangs on both ends of its diagonal, a sixth on
/// its other corners – a weight that is even is carried by stresses that are even in every cell,
/// and a bar that hangs lengthens as a row of springs.
std::vector<double> softMasses(const SoftDef& soft);

/// Whether springs make a lattice of such cells: they push if a cell is too flat.
bool hasLattice(const SoftDef& soft);

/// Its energies, by numbers of points plus `first`: five tetrahedra a cell, those of neighbours
/// mirrored, so that a box of even numbers of cells is as symmetric as it looks; or springs, or a
/// cell each.
std::vector<Element> softElements(const SoftDef& soft, int first = 0);

/// The springs of a lattice. With n along a spring of length l and stiffness k, a cell of volume V
/// stores Σ ½ k l² (n·ε n)², and two diagonals of a side a × b give
///   C_aabb = C_abab = 2 k a² b² / V (a² + b²)  and  2 k a⁴ / V (a² + b²) of C_aaaa.
/// So k = μ V (a² + b²)/2 a² b² of a diagonal and  μ V (3 − a²/b² − a²/c²)/a²  of the edges along a
/// are an isotropic solid with λ = μ. Cells share springs: each has its part of them.
std::vector<Element> latticeElements(const SoftDef& soft, int first);

/// A triangle of the surface, counter-clockwise from outside, and which of the six sides it is on.
struct SoftFace {
  std::array<int, 3> points;
  int side = 0;
};
std::vector<SoftFace> softFaces(const SoftDef& soft);

}  // namespace tumble
