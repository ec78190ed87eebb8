// Chapter 2, shape: faces in the plane of a cut.
#pragma once

#include <vector>

#include "sim/shape/cut.h"

namespace tumble::cut {

/// On which side of a plane each of the triangles stays that lie in it: −1 below, 1 above. What a
/// face bounds is behind it. But of two patches of faces that are folded on each other at an edge
/// the smaller stays with the larger: between them is less than the tolerance, and cut along, they
/// would hang from either side as leaves without volume.
/// @param n  [1] normal of the plane
std::vector<int> sidesWithin(const Points& points, const Surface& triangles, const Vec3& n);

}  // namespace tumble::cut
