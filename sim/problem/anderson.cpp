#include "sim/problem/anderson.h"

#include <algorithm>
#include <cmath>

namespace tumble {
namespace {

constexpr double kGrowth = 4.0;       ///< of |r|² beyond which the past is forgotten
constexpr double kRidge = 1e-14;      ///< of the least squares, relative
constexpr Eigen::Index kStrip = 256;  ///< rows that stay in the cache while all columns are read

}  // namespace

void Anderson::reset(const VecX& weight) {
  const Eigen::Index n = weight.size();
  root_ = weight.cwiseSqrt();
  r_.setZero(n);
  gBefore_.setZero(n);
  dr_.setZero(n, kDepth);
  dg_.setZero(n, kDepth);
  gram_.setZero();
  used_ = slot_ = 0;
  started_ = false;
}

/// The newest difference replaces the oldest one, with its row of the Gram matrix; right: dr·r.
void Anderson::remember(const VecX& x, const VecX& g, Small& right) {
  used_ = std::min(used_ + 1, kDepth);
  Small row = Small::Zero();
  right.setZero();
  const Eigen::Index n = r_.size();
  for (Eigen::Index first = 0; first < n; first += kStrip) {
    const Eigen::Index count = std::min(kStrip, n - first);
    auto r = r_.segment(first, count);
    auto dr = dr_.col(slot_).segment(first, count);
    dr = -r;
    r = (g - x).segment(first, count).cwiseProduct(root_.segment(first, count));
    dr += r;
    dg_.col(slot_).segment(first, count) = (g - gBefore_).segment(first, count);
    for (int i = 0; i < used_; ++i) {
      row[i] += dr_.col(i).segment(first, count).dot(dr);
      right[i] += dr_.col(i).segment(first, count).dot(r);
    }
  }
  gram_.row(slot_) = row.transpose();
  gram_.col(slot_) = row;
  slot_ = (slot_ + 1) % kDepth;
}

/// γ from the normal equations of  min |r − Σ γ dr|.
void Anderson::weigh(Small& gamma) const {
  Gram normal = gram_;
  normal.diagonal() *= 1.0 + kRidge;
  for (int i = used_; i < kDepth; ++i) normal(i, i) = 1.0;
  normal.ldlt().solveInPlace(gamma);
}

/// x = g − Σ γ dg.
void Anderson::mix(VecX& x, const VecX& g, const Small& gamma) const {
  for (Eigen::Index first = 0; first < g.size(); first += kStrip) {
    const Eigen::Index count = std::min(kStrip, g.size() - first);
    auto strip = x.segment(first, count);
    strip = g.segment(first, count);
    for (int i = 0; i < used_; ++i) strip -= gamma[i] * dg_.col(i).segment(first, count);
  }
}

void Anderson::next(VecX& x, const VecX& g) {
  const double size = (g - x).cwiseProduct(root_).squaredNorm();
  if (started_ && size > kGrowth * sizeBefore_) {
    started_ = false;
    used_ = slot_ = 0;
    gram_.setZero();
  }
  if (started_) {
    Small gamma;
    remember(x, g, gamma);
    weigh(gamma);
    if (!gamma.allFinite()) gamma.setZero();
    mix(x, g, gamma);
  } else {
    r_ = (g - x).cwiseProduct(root_);
    x = g;
  }
  gBefore_ = g;
  sizeBefore_ = size;
  started_ = true;
}

}  // namespace tumble
