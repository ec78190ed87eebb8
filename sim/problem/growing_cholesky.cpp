#include "sim/problem/growing_cholesky.h"

#include <cmath>

namespace tumble {

void GrowingCholesky::reset(int capacity) {
  size_ = 0;
  L_.setZero(capacity, capacity);
  work_.setZero(capacity);
  sine_.setZero(capacity);
  cosine_.setZero(capacity);
}

double GrowingCholesky::append(const VecX& column, double diagonal, double threshold) {
  // The new row of L solves L l = column.
  for (int k = 0; k < size_; ++k)
    work_[k] = (column[k] - L_.row(k).head(k).dot(work_.head(k))) / L_(k, k);
  const double pivot = diagonal - work_.head(size_).squaredNorm();
  if (!(pivot > threshold)) return pivot;
  L_.row(size_).head(size_) = work_.head(size_).transpose();
  L_(size_, size_) = std::sqrt(pivot);
  ++size_;
  return pivot;
}

void GrowingCholesky::remove(int k) {
  // What is left of the rows below k has one entry too many; plane rotations fold it into the rest.
  --size_;
  for (int i = k; i < size_; ++i) {
    L_.row(i).head(k) = L_.row(i + 1).head(k);
    double fold = L_(i + 1, k);
    for (int j = k; j < i; ++j) {
      const double entry = L_(i + 1, j + 1);
      L_(i, j) = cosine_[j] * entry + sine_[j] * fold;
      fold = cosine_[j] * fold - sine_[j] * entry;
    }
    const double diagonal = L_(i + 1, i + 1);
    const double length = std::sqrt(diagonal * diagonal + fold * fold);
    cosine_[i] = diagonal / length;
    sine_[i] = fold / length;
    L_(i, i) = length;
  }
}

void GrowingCholesky::solveInPlace(VecX& x) const {
  for (int k = 0; k < size_; ++k) x[k] = (x[k] - L_.row(k).head(k).dot(x.head(k))) / L_(k, k);
  for (int k = size_ - 1; k >= 0; --k) {
    x[k] /= L_(k, k);
    x.head(k) -= x[k] * L_.row(k).head(k).transpose();
  }
}

}  // namespace tumble
