// Chapter 6, problem: Anderson's acceleration of a fixed-point iteration.
#pragma once

#include "sim/math/vec.h"

namespace tumble {

/// Speeds up  x ← g(x):  mixes the last few g(x) so that the residual r = g(x) − x, taken as linear
/// in between, is smallest. Anderson 1965; Walker & Ni, SIAM J. Numer. Anal. 49, 2011, §2.
/// Safeguard: it forgets the past whenever the residual grew.
class Anderson {
 public:
  static constexpr int kDepth = 16;

  /// @param weight  of each entry in the norm of r, > 0
  void reset(const VecX& weight);

  /// Given x and g(x), puts the next x into both.
  void next(VecX& x, VecX& g);

 private:
  using Small = Eigen::Matrix<double, kDepth, 1>;
  using Gram = Eigen::Matrix<double, kDepth, kDepth>;

  void forget();
  void remember(const VecX& g, double size);
  Small weights() const;
  void mix(VecX& x, VecX& g, const Small& gamma);
  int column(int age) const { return (newest_ + kDepth - age) % kDepth; }

  VecX root_;                   // of the weight
  VecX r_, rBefore_, gBefore_;  // r times the root
  MatX dr_, dg_;                // differences, in a ring
  Gram gram_;                   // drᵀ dr, by age
  Small right_;                 // drᵀ r, by age
  int used_ = 0, newest_ = 0;
  double sizeBefore_ = 0.0;
  double largest_ = 0.0;  // |r|² since right_ was made anew
  bool started_ = false;
};

}  // namespace tumble
