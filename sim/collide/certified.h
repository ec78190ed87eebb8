// Chapter 5, collide: whether two convex polyhedra overlap, for certain.
#pragma once

#include "sim/shape/shape.h"

namespace tumble {

/// A signed gap and how much of it may be rounding. Its sign is right if |value| ≥ bound.
struct Gap {
  double value = 0.0;  ///< [m] > 0: a plane parts the two
  double bound = 0.0;  ///< [m]
};

/// Widest gap between two boxes or hulls over the faces of both and the pairs of edges that make a
/// face of their difference (see `convex::widenByEdges`). Its sign is that of exact arithmetic on
/// the numbers as they are stored:
///   points x + R(q) p_B,  R(q) the rotation of q / |q|, which need not be unit
/// In doubles first, with a bound of a few units in the last place of size and distance; where that
/// leaves the sign open, again in pairs of doubles (`DoubleDouble`). The bound is then 1e-26 of
/// size and distance, and for hulls also what rounding bends their faces of four corners and more.
/// @return bound at most 1e-14 (size + distance), for hulls whose faces are flat to 1e-15
/// @throws std::invalid_argument for other shapes.
Gap certifiedSeparation(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB);

}  // namespace tumble
