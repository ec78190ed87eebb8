// Chapter 2, shape: planes by which a piece may be cut that need not come apart exactly.
#pragma once

#include <vector>

#include "sim/shape/cut.h"

namespace tumble::cut {

/// Planes across the principal axes of a cloud of corners, at quarters of its length.
std::vector<CutPlane> planesAcross(const std::vector<Vec3>& corners);

/// Planes into a dent: through a point over it, all along the way down to its ground.
std::vector<CutPlane> planesInto(const Vec3& over, const Vec3& ground, double size);

/// Corners moved by up to `grain` [m], each by its own, so that no four of them lie in a plane: a
/// hull of these takes no question that needs whole numbers.
std::vector<Vec3> stirred(std::vector<Vec3> corners, double grain);

}  // namespace tumble::cut
