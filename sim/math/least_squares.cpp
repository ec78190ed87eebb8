#include "sim/math/least_squares.h"

#include <Eigen/QR>

namespace tumble {

/// [1] Equations that follow from the others leave no more than this.
constexpr double kDependent = 1e-11;

VecX leastSquares(const MatX& A, const VecX& b) {
  Eigen::CompleteOrthogonalDecomposition<MatX> orthogonal;
  orthogonal.setThreshold(kDependent);
  orthogonal.compute(A);
  return orthogonal.solve(b);
}

}  // namespace tumble
