// Chapter 2, shape: convex hulls measured, and joined where their union is convex.
#pragma once

#include <vector>

#include "sim/shape/polyhedron.h"

namespace tumble {

/// The convex hull of corners, in their own frame to the last bit.
Polyhedron hullInFrame(const std::vector<Vec3>& corners);

/// Volume [m³] and surface [m²].
double volumeOf(const Polyhedron& solid);
double areaOf(const Polyhedron& solid);

/// How far [m] a triangle lies under the surface of a convex solid around it, along its own normal,
/// at most; 0 of one with less than that area [m²].
double depthUnder(const Polyhedron& solid, const Vec3& a, const Vec3& b, const Vec3& c,
                  double area);

/// Joins convex solids that share no volume wherever two of them make a convex one: the hull of
/// both has no more volume than they have together, to `thin` [m] all over its surface. Solids
/// without corners are left out.
/// @param slack  [m] solids whose boxes are no further apart may touch
void joinConvex(std::vector<Polyhedron>& solids, double thin, double slack);

}  // namespace tumble
