#include "sim/problem/anderson.h"

#include <algorithm>
#include <cmath>

#include "sim/problem/lanes.h"

namespace tumble {
namespace {

constexpr double kGrowth = 4.0;       ///< of |r|² beyond which the past is forgotten
constexpr double kFresh = 0.5;        ///< of |r|² after which products with r are made anew
constexpr double kRidge = 1e-15;      ///< of the least squares, relative
constexpr Eigen::Index kStrip = 256;  ///< rows that stay in the cache while all columns are read

/// What two columns are along a vector.
Lanes products(const double* a, const double* b, const double* c, Eigen::Index count) {
  const auto two = [](const double* at) { return Lanes{at[0], at[1]}; };
  Lanes a1{}, a2{}, b1{}, b2{};
  Eigen::Index i = 0;
  for (; i + 4 <= count; i += 4) {
    const Lanes c1 = two(c + i), c2 = two(c + i + 2);
    a1 += two(a + i) * c1;
    b1 += two(b + i) * c1;
    a2 += two(a + i + 2) * c2;
    b2 += two(b + i + 2) * c2;
  }
  Lanes sums{sum(a1 + a2), sum(b1 + b2)};
  for (; i < count; ++i) sums += Lanes{a[i], b[i]} * c[i];
  return sums;
}

/// A quarter of the columns of A = L D Lᵀ, each from those before it: a column of L times its
/// pivot, the pivot's inverse, and Lᵀ. A column without a pivot is left out.
template <int quarter, typename Gram, typename Small>
void factor(const Gram& A, Gram& columns, Small& perPivot, Gram& transposed) {
  constexpr int kSize = Gram::RowsAtCompileTime, first = quarter * kSize / 4;
  constexpr int kBelow = kSize - first;
  for (int k = first; k < first + kSize / 4; ++k) {
    Eigen::Matrix<double, kBelow, 1> column = A.col(k).template tail<kBelow>();
    for (int j = 0; j < k; ++j) {
      transposed(j, k) = columns(k, j) * perPivot[j];
      column -= columns.col(j).template tail<kBelow>() * transposed(j, k);
    }
    columns.col(k).template tail<kBelow>() = column;
    const double pivot = columns(k, k) + kRidge * A(k, k);
    perPivot[k] = pivot > 0.0 ? 1.0 / pivot : 0.0;
  }
}

}  // namespace

void Anderson::reset(const VecX& weight) {
  const Eigen::Index n = weight.size();
  root_ = weight.cwiseSqrt();
  r_.setZero(n);
  rBefore_.setZero(n);
  gBefore_.setZero(n);
  dr_.resize(n, kDepth);
  dg_.resize(n, kDepth);
  forget();
}

/// Columns are read by fours: up to three more than are in use, which are those behind the newest.
void Anderson::forget() {
  for (int age = 0; age < 3; ++age) {
    dr_.col(column(age)).setZero();
    dg_.col(column(age)).setZero();
  }
  gram_.setZero();
  right_.setZero();
  used_ = 0;
  largest_ = 0.0;
  started_ = false;
}

/// The newest difference replaces the oldest one. Products with r go on by those with the newest
/// difference, by which r has moved, until r has become much smaller than what they add up.
void Anderson::remember(const VecX& g, double size) {
  newest_ = (newest_ + 1) % kDepth;
  used_ = std::min(used_ + 1, kDepth);
  largest_ = std::max(largest_, size);
  const bool fresh = size < kFresh * largest_;
  if (fresh) largest_ = size;

  Small row = Small::Zero(), along = Small::Zero();
  const Eigen::Index n = r_.size();
  for (Eigen::Index first = 0; first < n; first += kStrip) {
    const Eigen::Index count = std::min(kStrip, n - first);
    const auto r = r_.segment(first, count);
    auto dr = dr_.col(newest_).segment(first, count);
    dr = r - rBefore_.segment(first, count);
    dg_.col(newest_).segment(first, count) = (g - gBefore_).segment(first, count);
    const auto add = [&](const double* vector, Small& sums, int most) {
      for (int i = 0; i < most; i += 2) {
        const Lanes more =
            products(&dr_(first, column(i)), &dr_(first, column(i + 1)), vector, count);
        sums[i] += more[0];
        sums[i + 1] += more[1];
      }
    };
    add(dr.data(), row, used_);
    add(r.data(), along, fresh ? used_ : 1);
  }
  if (used_ % 2 == 1) row[used_] = along[used_] = 0.0;  // of a column that is forgotten

  // All are a place older: a step down the diagonal.
  std::copy_backward(gram_.data(), gram_.data() + gram_.size() - kDepth - 1,
                     gram_.data() + gram_.size());
  gram_.row(0) = row.transpose();
  gram_.col(0) = row;
  right_.tail<kDepth - 1>() = right_.head<kDepth - 1>().eval();
  right_ += row;
  right_[0] = along[0];
  if (fresh) right_ = along;
}

/// γ from the normal equations of  min |r − Σ γ dr|,  which are L D Lᵀ with the newest column
/// first: one that newer ones make up to rounding is left out. Quarters without a difference are
/// zero, and so is their γ.
Anderson::Small Anderson::weights() const {
  constexpr int kQuarter = kDepth / 4;
  Gram columns, transposed;
  Small perPivot = Small::Zero(), gamma = right_;
  factor<0>(gram_, columns, perPivot, transposed);
  if (used_ > kQuarter) factor<1>(gram_, columns, perPivot, transposed);
  if (used_ > 2 * kQuarter) factor<2>(gram_, columns, perPivot, transposed);
  if (used_ > 3 * kQuarter) factor<3>(gram_, columns, perPivot, transposed);
  for (int k = 0; k < used_; ++k)
    for (int j = 0; j < k; ++j) gamma[k] -= transposed(j, k) * gamma[j];
  gamma.array() *= perPivot.array();
  for (int k = used_ - 1; k > 0; --k)
    for (int j = 0; j < k; ++j) gamma[j] -= transposed(j, k) * gamma[k];
  return gamma;
}

/// x = g − Σ γ dg, which then is g as well; what g was is kept.
void Anderson::mix(VecX& x, VecX& g, const Small& gamma) {
  static_assert(kDepth % 4 == 0);
  const Eigen::Index n = g.size();
  for (Eigen::Index first = 0; first < n; first += kStrip) {
    const Eigen::Index count = std::min(kStrip, n - first);
    auto strip = g.segment(first, count);
    gBefore_.segment(first, count) = strip;
    const auto dg = [&](int i) { return dg_.col(column(i)).segment(first, count); };
    for (int i = 0; i < used_; i += 4)
      strip = strip - gamma[i] * dg(i) - gamma[i + 1] * dg(i + 1) - gamma[i + 2] * dg(i + 2) -
              gamma[i + 3] * dg(i + 3);
    x.segment(first, count) = strip;
  }
}

void Anderson::next(VecX& x, VecX& g) {
  r_ = (g - x).cwiseProduct(root_);
  const double size = r_.squaredNorm();
  if (started_ && size > kGrowth * sizeBefore_) forget();
  if (started_) {
    remember(g, size);
    Small gamma = weights();
    if (!gamma.allFinite()) gamma.setZero();
    mix(x, g, gamma);
  } else {
    gBefore_ = g;
    x = g;
  }
  rBefore_.swap(r_);
  sizeBefore_ = size;
  started_ = true;
}

}  // namespace tumble
