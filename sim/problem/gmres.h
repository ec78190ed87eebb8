// Chapter 6, problem: linear problems of points whose matrix is known by what it does.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "sim/math/vec.h"

namespace tumble {

/// Solves H x = b for an H that a matrix with a factor, P, comes near to: the combination of
/// P⁻¹ b, P⁻¹ H P⁻¹ b, … that leaves least of b (Saad & Schultz, GMRES: A Generalized Minimal
/// Residual Algorithm, 1986, preconditioned from the right).
class Gmres {
 public:
  /// x takes the place of b, of which at most a part is left, or what kMost rounds leave.
  /// @param apply    apply(x, out): out = H x
  /// @param prepare  x ← P⁻¹ x
  template <class Apply, class Prepare>
  void solve(std::vector<Vec3>& b, double part, const Apply& apply, const Prepare& prepare);

 private:
  static constexpr int kMost = 24;  // rounds

  static double dot(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
    return sum;
  }
  static void add(std::vector<Vec3>& a, double factor, const std::vector<Vec3>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
  }
  /// Scales it to length 1. @return the length that it had
  static double normalise(std::vector<Vec3>& a) {
    const double size = std::sqrt(dot(a, a));
    if (size > 0.0)
      for (Vec3& x : a) x /= size;
    return size;
  }

  std::vector<Vec3> basis_[kMost + 1];  // orthonormal
  std::vector<Vec3> way_;
};

template <class Apply, class Prepare>
void Gmres::solve(std::vector<Vec3>& b, double part, const Apply& apply, const Prepare& prepare) {
  Eigen::Matrix<double, kMost + 1, kMost> R = decltype(R)::Zero();  // turned to a triangle,
  Eigen::Matrix<double, kMost + 1, 1> left = decltype(left)::Zero();
  double c[kMost], s[kMost];  // by these
  basis_[0] = b;
  const double size = left[0] = normalise(basis_[0]);
  int k = 0;
  for (; k < kMost && std::abs(left[k]) > part * size; ++k) {
    way_ = basis_[k];
    prepare(std::span(way_));
    std::vector<Vec3>& next = basis_[k + 1];
    next.resize(b.size());
    apply(std::span<const Vec3>(way_), std::span(next));
    for (int j = 0; j <= k; ++j) {
      R(j, k) = dot(next, basis_[j]);
      add(next, -R(j, k), basis_[j]);
    }
    const double below = normalise(next);
    for (int j = 0; j < k; ++j) {
      const double upper = R(j, k), lower = R(j + 1, k);
      R(j, k) = c[j] * upper + s[j] * lower;
      R(j + 1, k) = c[j] * lower - s[j] * upper;
    }
    const double length = std::hypot(R(k, k), below);
    if (!(length > 0.0)) break;
    c[k] = R(k, k) / length;
    s[k] = below / length;
    R(k, k) = length;
    left[k + 1] = -s[k] * left[k];
    left[k] *= c[k];
  }
  for (Vec3& x : b) x.setZero();
  for (int j = k - 1; j >= 0; --j) {
    double share = left[j];
    for (int m = j + 1; m < k; ++m) share -= R(j, m) * left[m];
    left[j] = share / R(j, j);
    add(b, left[j], basis_[j]);
  }
  prepare(std::span(b));
}

}  // namespace tumble
