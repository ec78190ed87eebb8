#include "sim/problem/anderson.h"

#include <algorithm>
#include <cmath>

#include "sim/problem/lanes.h"

namespace tumble {
namespace {

constexpr double kGrowth = 4.0;       ///< of |r|² beyond which the past is forgotten
constexpr double kRidge = 1e-14;      ///< of the least squares, relative
constexpr Eigen::Index kStrip = 256;  ///< rows that stay in the cache while all columns are read

/// What two columns are along two vectors.
struct Products {
  double ac, ad, bc, bd;
};

/// Sums of products in four parts each, as Eigen has them.
Products products(const double* a, const double* b, const double* c, const double* d,
                  Eigen::Index count) {
  struct Sums {
    Lanes ac{}, ad{}, bc{}, bd{};
    void add(Lanes a, Lanes b, Lanes c, Lanes d) {
      ac += a * c;
      ad += a * d;
      bc += b * c;
      bd += b * d;
    }
  } one, other;
  const auto two = [](const double* at) { return Lanes{at[0], at[1]}; };
  Eigen::Index i = 0;
  for (; i + 4 <= count; i += 4) {
    one.add(two(a + i), two(b + i), two(c + i), two(d + i));
    other.add(two(a + i + 2), two(b + i + 2), two(c + i + 2), two(d + i + 2));
  }
  Sums all{one.ac + other.ac, one.ad + other.ad, one.bc + other.bc, one.bd + other.bd};
  if (i + 2 <= count) {
    all.add(two(a + i), two(b + i), two(c + i), two(d + i));
    i += 2;
  }
  Products sums{sum(all.ac), sum(all.ad), sum(all.bc), sum(all.bd)};
  if (i < count) {
    sums.ac += a[i] * c[i];
    sums.ad += a[i] * d[i];
    sums.bc += b[i] * c[i];
    sums.bd += b[i] * d[i];
  }
  return sums;
}

/// A quarter of the columns of L and their pivots, each from the columns before it.
template <int quarter, typename Gram, typename Small>
void takeQuarter(Gram& L, Small& D) {
  constexpr int kSize = Gram::RowsAtCompileTime, first = quarter * kSize / 4;
  using Below = Eigen::Matrix<double, kSize - first, 1>;
  for (int k = first; k < first + kSize / 4; ++k) {
    Below taken = Below::Zero();
    for (int j = 0; j < k; ++j) taken += (D[j] * L(k, j)) * L.col(j).template tail<kSize - first>();
    auto column = L.col(k).template tail<kSize - first>();
    column -= taken;
    D[k] = L(k, k);
    if (D[k] != 0.0) column /= D[k];
  }
}

}  // namespace

void Anderson::reset(const VecX& weight) {
  const Eigen::Index n = weight.size();
  root_ = weight.cwiseSqrt();
  r_.setZero(n);
  rBefore_.setZero(n);
  gBefore_.setZero(n);
  dr_.setZero(n, kDepth);
  dg_.setZero(n, kDepth);
  gram_.setZero();
  used_ = slot_ = 0;
  started_ = false;
}

/// The newest difference replaces the oldest one, with its row of the Gram matrix; right: dr·r.
void Anderson::remember(const VecX& g, Small& right) {
  used_ = std::min(used_ + 1, kDepth);
  Small row = Small::Zero();
  right.setZero();
  const Eigen::Index n = r_.size();
  for (Eigen::Index first = 0; first < n; first += kStrip) {
    const Eigen::Index count = std::min(kStrip, n - first);
    const auto r = r_.segment(first, count);
    auto dr = dr_.col(slot_).segment(first, count);
    dr = r - rBefore_.segment(first, count);
    dg_.col(slot_).segment(first, count) = (g - gBefore_).segment(first, count);
    for (int i = 0; i < used_; i += 2) {
      const Products more =
          products(&dr_(first, i), &dr_(first, i + 1), dr.data(), r.data(), count);
      row[i] += more.ac;
      right[i] += more.ad;
      row[i + 1] += more.bc;
      right[i + 1] += more.bd;
    }
  }
  if (used_ % 2 == 1) row[used_] = right[used_] = 0.0;  // of a column that is forgotten
  gram_.row(slot_) = row.transpose();
  gram_.col(slot_) = row;
  slot_ = (slot_ + 1) % kDepth;
}

/// γ from the normal equations of  min |r − Σ γ dr|.  They are L D Lᵀ with the largest column
/// first; rows that are not used yet are those of the identity.
void Anderson::weigh(Small& gamma) const {
  // Sizes mostly fall from the oldest column to the newest.
  Small diagonal = gram_.diagonal() * (1.0 + kRidge);
  for (int i = used_; i < kDepth; ++i) diagonal[i] = 1.0;
  int at[kDepth];
  for (int i = 0; i < kDepth; ++i) {
    const int column = (slot_ + i) % kDepth;
    int k = i;
    for (; k > 0 && diagonal[column] > diagonal[at[k - 1]]; --k) at[k] = at[k - 1];
    at[k] = column;
  }
  Gram L;
  Small D, x;
  for (int j = 0; j < kDepth; ++j) {
    const double* column = gram_.data() + kDepth * at[j];
    for (int i = 0; i < kDepth; ++i) L.data()[kDepth * j + i] = column[at[i]];
    L(j, j) = diagonal[at[j]];
    x[j] = gamma[at[j]];
  }
  takeQuarter<0>(L, D);
  takeQuarter<1>(L, D);
  takeQuarter<2>(L, D);
  takeQuarter<3>(L, D);
  L.triangularView<Eigen::UnitLower>().solveInPlace(x);
  for (int i = 0; i < kDepth; ++i) x[i] = D[i] != 0.0 ? x[i] / D[i] : 0.0;
  L.transpose().triangularView<Eigen::UnitUpper>().solveInPlace(x);
  for (int i = 0; i < kDepth; ++i) gamma[at[i]] = x[i];
}

/// x = g − Σ γ dg, which then is g as well; what g was is kept.
void Anderson::mix(VecX& x, VecX& g, const Small& gamma) {
  static_assert(kDepth % 4 == 0);
  const Eigen::Index n = g.size();
  for (Eigen::Index first = 0; first < n; first += kStrip) {
    const Eigen::Index count = std::min(kStrip, n - first);
    auto strip = g.segment(first, count);
    gBefore_.segment(first, count) = strip;
    const auto dg = [&](int i) { return dg_.col(i).segment(first, count); };
    for (int i = 0; i < used_; i += 4)
      strip = strip - gamma[i] * dg(i) - gamma[i + 1] * dg(i + 1) - gamma[i + 2] * dg(i + 2) -
              gamma[i + 3] * dg(i + 3);
    x.segment(first, count) = strip;
  }
}

void Anderson::next(VecX& x, VecX& g) {
  r_ = (g - x).cwiseProduct(root_);
  const double size = r_.squaredNorm();
  if (started_ && size > kGrowth * sizeBefore_) {
    started_ = false;
    used_ = slot_ = 0;
    gram_.setZero();
  }
  if (started_) {
    Small gamma;
    remember(g, gamma);
    weigh(gamma);
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
