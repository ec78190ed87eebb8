// Chapter 3, body: the axes about which a body turns as if it were a box.
#pragma once

#include "sim/math/vec.h"

namespace tumble {

/// I = axes diag(moments) axesᵀ: the columns of `axes` are the principal axes in body coordinates.
struct PrincipalAxes {
  Vec3 moments = Vec3::Ones();   ///< [kg m²], in the order of the axes, not sorted
  Mat3 axes = Mat3::Identity();  ///< a proper rotation, det = +1: principal frame to body frame
};

/// Principal axes of an inertia tensor, by cyclic Jacobi rotations (Golub and Van Loan, Matrix
/// Computations, §8.5): small moments keep their digits beside large ones. A tensor that is
/// diagonal already keeps its own axes, bit for bit; among equal moments the axes are as the
/// rotations leave them.
/// @param inertia  symmetric, [kg m²]
PrincipalAxes principalAxes(const Mat3& inertia);

}  // namespace tumble
