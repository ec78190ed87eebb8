// Chapter 0, math: systems of equations of any rank.
#pragma once

#include <Eigen/QR>

#include "sim/math/vec.h"

namespace tumble {

/// The shortest of all x that minimise |A x − b|, for one A and many b. Equations that follow from
/// the others to a share `dependent` of the largest count as following exactly. By a complete
/// orthogonal decomposition, A P = Q T Z. Allocates only where A takes another shape.
class LeastSquares {
 public:
  static constexpr double kDependent = 1e-11;  ///< what rounding leaves of a dependence

  void factor(const Eigen::Ref<const MatX>& A, double dependent = kDependent);
  /// @return x, good until the next call
  const VecX& solve(const Eigen::Ref<const VecX>& b);

 private:
  Eigen::CompleteOrthogonalDecomposition<MatX> orthogonal_;
  VecX c_, y_, x_;
};

/// The same for one b.
VecX leastSquares(const MatX& A, const VecX& b);

/// x in the range of the symmetric R with  Rᵀ (A x − b) = 0, the shortest of them. leastSquares(A,
/// b) where R is regular.
VecX leastSquaresWithin(const MatX& R, const MatX& A, const VecX& b);

}  // namespace tumble
