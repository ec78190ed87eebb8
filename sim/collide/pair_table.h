// Chapter 5, collide: one row of the table of shape pairs, read in either order. Convex solids and
// half-spaces only; `collide.h` takes compounds apart.
#pragma once

#include "sim/collide/contact_point.h"
#include "sim/shape/shape.h"

namespace tumble::pairs {

/// True if the table has a row for these two kinds of shape.
bool inTable(const Shape& a, const Shape& b);

/// As in collide.h. Without a row: infinitely far apart.
double separationOf(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB);
ContactPoint planeOf(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB);
/// Appends to `out`.
void pointsOf(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB, double margin,
              Manifold& out);

}  // namespace tumble::pairs
