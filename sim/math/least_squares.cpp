#include "sim/math/least_squares.h"

#include <utility>

namespace tumble {

void LeastSquares::factor(const Eigen::Ref<const MatX>& A, double dependent) {
  orthogonal_.setThreshold(dependent);
  orthogonal_.compute(A);
}

// As Eigen's own solve does, to the last bit, in storage that is kept.
const VecX& LeastSquares::solve(const Eigen::Ref<const VecX>& b) {
  const Eigen::Index rank = orthogonal_.rank(), rows = orthogonal_.rows(),
                     cols = orthogonal_.cols();
  const MatX& factors = orthogonal_.matrixQTZ();
  double along = 0.0;  // where a reflection keeps its inner product
  // c = Qᵀ b
  c_ = b;
  for (Eigen::Index k = 0; k < rank; ++k)
    c_.tail(rows - k).applyHouseholderOnTheLeft(factors.col(k).tail(rows - k - 1),
                                                orthogonal_.hCoeffs()[k], &along);
  // T y = c, of which the first entries are asked for.
  y_.setZero(cols);
  y_.head(rank) = c_.head(rank);
  factors.topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solveInPlace(y_.head(rank));
  // x = P Zᵀ y: reflections, each of one entry and all those beyond the rank.
  for (Eigen::Index k = 0; k < rank && rank < cols; ++k) {
    std::swap(y_[k], y_[rank - 1]);
    y_.tail(cols - rank + 1)
        .applyHouseholderOnTheLeft(factors.row(k).tail(cols - rank).adjoint(),
                                   orthogonal_.zCoeffs()[k], &along);
    std::swap(y_[k], y_[rank - 1]);
  }
  x_.resize(cols);
  for (Eigen::Index i = 0; i < cols; ++i) x_[orthogonal_.colsPermutation().indices()[i]] = y_[i];
  return x_;
}

VecX leastSquares(const MatX& A, const VecX& b) {
  LeastSquares system;
  system.factor(A);
  return system.solve(b);
}

VecX leastSquaresWithin(const MatX& R, const MatX& A, const VecX& b) {
  Eigen::ColPivHouseholderQR<MatX> basis;
  basis.setThreshold(LeastSquares::kDependent);
  basis.compute(R);
  if (basis.rank() == R.rows()) return leastSquares(A, b);
  if (basis.rank() == 0) return VecX::Zero(R.rows());
  const MatX Q = basis.householderQ() * MatX::Identity(R.rows(), basis.rank());
  return Q * leastSquares(Q.transpose() * A * Q, Q.transpose() * b);
}

}  // namespace tumble
