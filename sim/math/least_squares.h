// Chapter 0, math: systems of equations of any rank.
#pragma once

#include "sim/math/vec.h"

namespace tumble {

/// The shortest of all x that minimise |A x − b|. Equations that follow from the others to 1e-11
/// of the largest count as following exactly. By a complete orthogonal decomposition.
VecX leastSquares(const MatX& A, const VecX& b);

}  // namespace tumble
