#include "sim/problem/anderson.h"

#include <cmath>

namespace tumble {
namespace {

constexpr double kGrowth = 100.0;  ///< of |r|² beyond which the past is forgotten
constexpr double kRidge = 1e-14;   ///< of the least squares, relative

using Small = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Anderson::kDepth, 1>;

}  // namespace

void Anderson::reset(const VecX& weight) {
  const Eigen::Index n = weight.size();
  weight_ = weight;
  r_.setZero(n);
  rBefore_.setZero(n);
  gBefore_.setZero(n);
  dr_.resize(kDepth);
  dg_.resize(kDepth);
  for (VecX& column : dr_) column.setZero(n);
  for (VecX& column : dg_) column.setZero(n);
  gram_.setZero();
  used_ = slot_ = 0;
  started_ = false;
}

void Anderson::next(VecX& x, const VecX& g) {
  r_ = g - x;
  const double size = r_.cwiseAbs2().dot(weight_);
  x = g;
  if (started_ && size > kGrowth * sizeBefore_) {
    started_ = false;
    used_ = slot_ = 0;
  }
  if (started_) {
    // The newest difference replaces the oldest one, with its row of the Gram matrix.
    dr_[slot_] = r_ - rBefore_;
    dg_[slot_] = g - gBefore_;
    used_ = std::min(used_ + 1, kDepth);
    for (int i = 0; i < used_; ++i)
      gram_(i, slot_) = gram_(slot_, i) = dr_[i].cwiseProduct(weight_).dot(dr_[slot_]);
    slot_ = (slot_ + 1) % kDepth;

    // x = g − Σ γ dg with γ from the normal equations of  min |r − Σ γ dr|.
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kDepth, kDepth> normal =
        gram_.topLeftCorner(used_, used_);
    Small gamma(used_);
    for (int i = 0; i < used_; ++i) {
      normal(i, i) *= 1.0 + kRidge;
      gamma[i] = dr_[i].cwiseProduct(weight_).dot(r_);
    }
    normal.ldlt().solveInPlace(gamma);
    if (gamma.allFinite())
      for (int i = 0; i < used_; ++i) x -= gamma[i] * dg_[i];
  }
  rBefore_ = r_;
  gBefore_ = g;
  sizeBefore_ = size;
  started_ = true;
}

}  // namespace tumble
