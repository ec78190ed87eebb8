// Chapter 6, problem: a Cholesky factor whose matrix gains and loses rows.
#pragma once

#include "sim/math/vec.h"

namespace tumble {

/// Lower triangular L with L Lᵀ = S for a symmetric positive definite S that grows at its end and
/// shrinks anywhere. Golub & Van Loan, Matrix Computations, §6.5. O(n²) per change.
class GrowingCholesky {
 public:
  /// Forgets everything and makes room for `capacity` rows.
  void reset(int capacity);

  int size() const { return size_; }

  /// Appends a row and column to S: `column` against the rows already there, `diagonal` on its own.
  /// @return the Schur pivot  diagonal − columnᵀ S⁻¹ column.  Nothing is appended unless it exceeds
  ///         `threshold`: the new row depends on the old ones as far as rounding lets us see.
  double append(const VecX& column, double diagonal, double threshold);

  /// Deletes row and column k of S.
  void remove(int k);

  /// x = S⁻¹ x for the first size() entries.
  void solveInPlace(VecX& x) const;

 private:
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> L_;
  VecX work_, sine_, cosine_;
  int size_ = 0;
};

}  // namespace tumble
