// Chapter 2, shape: the convex hull of points.
#pragma once

#include <vector>

#include "sim/shape/polyhedron.h"

namespace tumble {

/// The smallest convex solid that holds the points, less the first of them: points may stand
/// anywhere, as in `makePolyhedron`. Its points are the corners, in the order given; others and
/// copies are left out. Faces that lie in one plane to 1e-12 of the solid's size, and to what
/// rounding of the points given may bend it by, are one polygon.
///   Quickhull (Barber, Dobkin and Huhdanpaa, "The Quickhull Algorithm for Convex Hulls", 1996).
///   Departure: what a point sees is decided exactly, by `orientation`, in place of thick facets.
/// @param points  [m]
/// @throws NotASolid  for fewer than four points, one that is not finite, or points within 1e-9 of
///                    their size of one point, one line or one plane; the text says which.
Polyhedron convexHull(const std::vector<Vec3>& points);

/// The same in the frame of the points: corners keep all their digits, and every face is convex to
/// rounding, however narrow.
Polyhedron hullInFrame(const std::vector<Vec3>& points);

}  // namespace tumble
