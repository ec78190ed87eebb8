#include "sim/flight/polhode.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/math/double_double.h"

namespace tumble {
namespace {

using Triple = std::array<DoubleDouble, 3>;

/// Below this, squares of components may vanish.
constexpr double kNothing = 1e-140;

/// Rᵀ L |q|² = (w² − u·u) L + 2 (u·L) u − 2 w u × L, with twice the digits, so that small
/// components in the body are as good as large ones.
Triple inBody(const Quat& q, const Vec3& L) {
  const double w = q.w();
  const Vec3 u = q.vec();
  const auto sum = [](const DoubleDouble& a, const DoubleDouble& b, const DoubleDouble& c) {
    return a + b + c;
  };
  const DoubleDouble uu =
      sum(twoProduct(u.x(), u.x()), twoProduct(u.y(), u.y()), twoProduct(u.z(), u.z()));
  const DoubleDouble uL =
      sum(twoProduct(u.x(), L.x()), twoProduct(u.y(), L.y()), twoProduct(u.z(), L.z()));
  const DoubleDouble scale = twoProduct(w, w) - uu;
  Triple l;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const DoubleDouble across = twoProduct(u[j], L[k]) - twoProduct(u[k], L[j]);
    l[i] = L[i] * scale + 2.0 * (u[i] * uL - w * across);
  }
  return l;
}

/// d_k L_k²: |I₂ − I_k| I_other L_k², with twice the digits.
DoubleDouble hold(double I2, double Ik, double Iother, const DoubleDouble& Lk) {
  const DoubleDouble difference = I2 > Ik ? twoSum(I2, -Ik) : twoSum(Ik, -I2);
  return Iother * difference * (Lk * Lk);
}

/// Principal moments and axes (columns) of a symmetric tensor; the axes of the frame if it is
/// diagonal.
std::pair<Vec3, Mat3> principal(const Mat3& I) {
  if (I.isDiagonal(0.0)) return {I.diagonal(), Mat3::Identity()};
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(I);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Vec3 rounded(const Triple& a) {
  return {a[0].hi, a[1].hi, a[2].hi};
}

}  // namespace

Polhode::Polhode(const Mat3& Ibody, const Quat& q, const Vec3& momentum) : L(momentum.norm()) {
  // The angular momentum along the principal axes.
  const std::pair<Vec3, Mat3> frame = principal(Ibody);
  const Vec3& moments = frame.first;
  const Mat3& axes = frame.second;
  Triple L_P = inBody(q, momentum);
  if (!Ibody.isDiagonal(0.0)) {
    const Vec3 turned = axes.transpose() * rounded(L_P);
    for (int i = 0; i < 3; ++i) L_P[i] = {turned[i], 0.0};
  }
  const double length = rounded(L_P).norm();
  axes_B = axes;
  I = moments;
  if (!(length > kNothing)) {
    L = 0.0;
    return;
  }

  // Axis 3 is the one, of those with the least and the greatest moment, that holds the spin.
  std::array<int, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return moments[i] < moments[j]; });
  auto [first, middle, third] = order;
  const double I2 = moments[middle];
  DoubleDouble hold1 = hold(I2, moments[first], moments[third], L_P[first]);
  DoubleDouble hold3 = hold(I2, moments[third], moments[first], L_P[third]);
  const double excess = (hold3 - hold1).hi;
  const bool closer = I2 - moments[first] > moments[third] - I2;
  if (excess < 0.0 || (excess == 0.0 && closer)) {
    std::swap(first, third);
    std::swap(hold1, hold3);
  }
  I = Vec3(moments[first], I2, moments[third]);
  sense = I[0] < I[2] ? 1.0 : -1.0;

  // Axes 1 and 3 are turned so that L leans towards them.
  axes_B.col(0) = (L_P[first].hi < 0.0 ? -1.0 : 1.0) * axes.col(first);
  axes_B.col(2) = (L_P[third].hi < 0.0 ? -1.0 : 1.0) * axes.col(third);
  axes_B.col(1) = axes_B.col(2).cross(axes_B.col(0));
  const double turn = axes_B.col(1).dot(axes.col(middle)) < 0.0 ? -1.0 : 1.0;
  l = Vec3(std::abs(L_P[first].hi), turn * L_P[middle].hi, std::abs(L_P[third].hi)) / length;

  d1 = I[2] * std::abs(I[1] - I[0]);
  d3 = I[0] * std::abs(I[2] - I[1]);
  d = I[1] * std::abs(I[2] - I[0]);
  const Vec3 squares = l.cwiseAbs2();
  const bool spinsAbout2 = squares[0] + squares[2] < kNothing * kNothing;
  const bool spinsAbout3 = squares[0] + squares[1] < kNothing * kNothing;
  if (d3 == 0.0 || spinsAbout2 || spinsAbout3) return;

  kind = d1 == 0.0 ? Kind::Circle : Kind::Elliptic;
  a1 = std::sqrt(squares[0] + squares[1] * (d3 / d));
  a2 = std::sqrt(squares[1] + squares[0] * (d / d3));
  a3 = std::sqrt(squares[2] + squares[1] * (d1 / d));
  const double volume = I[0] * I[1] * I[2];
  s1 = std::sqrt(d1 * (d * squares[0] + d3 * squares[1])) / volume;
  s3 = std::sqrt(d3 * (d * squares[2] + d1 * squares[1])) / volume;
  s = std::sqrt(d * (hold3 - hold1).hi) / (length * volume);
}

double Polhode::turning() const {
  const Vec3 rates = L * I.cwiseInverse();
  if (kind == Kind::Rest) {
    const double omega = L == 0.0 ? 0.0 : rates.cwiseProduct(l).norm();
    return omega * omega;
  }
  // l² where sn u is 0, and how it changes to where sn² u is 1.
  const Vec3 from(a1 * a1, 0.0, a3 * a3);
  const Vec3 to(0.0, a2 * a2, a3 * a3 * (s / s3) * (s / s3));
  const Vec3 squares = rates.cwiseAbs2();
  const double omega2 = std::max(squares.dot(from), squares.dot(to));

  // ω̇ = I⁻¹ (L × ω): component i is  rates_i (rates_k − rates_j) l_j l_k.
  double c0 = 0.0, c1 = 0.0, c2 = 0.0;  // |ω̇|² = c0 + c1 y + c2 y²,  y = sn² u
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double factor = rates[i] * (rates[k] - rates[j]);
    const double w = factor * factor, dj = to[j] - from[j], dk = to[k] - from[k];
    c0 += w * from[j] * from[k];
    c1 += w * (from[j] * dk + from[k] * dj);
    c2 += w * dj * dk;
  }
  double most = std::max(c0, c0 + c1 + c2);
  const double top = c2 < 0.0 ? -0.5 * c1 / c2 : 0.0;
  if (top > 0.0 && top < 1.0) most = std::max(most, c0 + top * (c1 + top * c2));

  // The last factor covers rounding.
  return (0.5 * omega2 + std::sqrt(0.25 * omega2 * omega2 + most)) * (1.0 + 1e-12);
}

}  // namespace tumble
