// Chapter 2, elastic: a rectangle of cloth as points and energies.
#pragma once

#include <vector>

#include "sim/elastic/elastic_body.h"

namespace tumble {

/// A rectangle of cloth in its own frame: threads along X (u) and Z (v), its middle at the origin,
/// its normal Y.
struct ClothDef {
  int columns = 2, rows = 2;             ///< points along u and v
  double length = 1.0, width = 1.0;      ///< [m] along u and v
  double density = 0.2;                  ///< [kg/m²]
  double stretch = 100.0, shear = 20.0;  ///< [N/m]
  double bend = 1e-5;                    ///< [N m]
  double damping = 0.0;                  ///< [N s/m] of stretch and shear
};

/// Number of the point in a column and a row.
inline int clothPoint(const ClothDef& cloth, int column, int row) {
  return row * cloth.columns + column;
}

/// Places of the points when flat, in the cloth's frame [m].
std::vector<Vec3> clothPlaces(const ClothDef& cloth);

/// Masses [kg] of the points: a quarter of each cell around them, so that half and a quarter of the
/// inner ones at edges and corners.
std::vector<double> clothMasses(const ClothDef& cloth);

/// Its energies, by numbers of points plus `first`: threads as springs, cells that shear in their
/// middle, and threads and cells that bend as a plate does whose Poisson's ratio is 0. Mirrored and
/// turned by quarters it is the same cloth: no cell has a diagonal.
std::vector<Element> clothElements(const ClothDef& cloth, int first = 0);

/// Triangles of its sheet, by numbers of points plus `first`, seen from +Y counter-clockwise.
/// Diagonals point to the middle, so that it is as symmetric as the cloth.
std::vector<std::array<int, 3>> clothTriangles(const ClothDef& cloth, int first = 0);

/// Its sheet, of so many metres' thickness t, by numbers of points plus `first`. Cloth keeps cloth
/// off so that a cell of it that comes with 4 m/s stops within t/2:  k = m (2 · 4 m/s / t)².
Sheet clothSheet(const ClothDef& cloth, double thickness, int first = 0);

}  // namespace tumble
