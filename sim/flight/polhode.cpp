#include "sim/flight/polhode.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/body/principal_axes.h"
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

Vec3 rounded(const Triple& a) {
  return {a[0].hi, a[1].hi, a[2].hi};
}

/// Which body axes are 1, 2, 3, and  d₃ L₃² − d₁ L₁² ≥ 0.
struct Order {
  std::array<int, 3> axis = {0, 1, 2};
  double excess = 0.0;
};

/// Axis 3 is the one, of those with the least and the greatest moment, that holds the spin.
Order jacobiOrder(const Vec3& I, const Triple& L) {
  Order order;
  auto& [first, middle, third] = order.axis;
  std::sort(order.axis.begin(), order.axis.end(), [&](int i, int j) { return I[i] < I[j]; });
  const DoubleDouble hold1 = hold(I[middle], I[first], I[third], L[first]);
  const DoubleDouble hold3 = hold(I[middle], I[third], I[first], L[third]);
  order.excess = (hold3 - hold1).hi;
  const bool closer = I[middle] - I[first] > I[third] - I[middle];
  if (order.excess < 0.0 || (order.excess == 0.0 && closer)) {
    std::swap(first, third);
    order.excess = -order.excess;
  }
  return order;
}

}  // namespace

Polhode::Polhode(const Mat3& Ibody, const Quat& q, const Vec3& momentum) : L(momentum.norm()) {
  // The angular momentum along the principal axes.
  const PrincipalAxes frame = principalAxes(Ibody);
  I = frame.moments;
  axes_B = frame.axes;
  Triple L_P = inBody(q, momentum);
  if (!Ibody.isDiagonal(0.0)) {
    const Vec3 turned = axes_B.transpose() * rounded(L_P);
    for (int i = 0; i < 3; ++i) L_P[i] = {turned[i], 0.0};
  }
  const double length = rounded(L_P).norm();
  if (!(length > kNothing)) {
    L = 0.0;
    return;
  }

  const Order order = jacobiOrder(I, L_P);
  layAxes(order.axis, rounded(L_P) / length);
  measure(std::sqrt(order.excess) / length);
}

void Polhode::layAxes(const std::array<int, 3>& axis, const Vec3& direction) {
  const Mat3 axes = axes_B;
  const Vec3 moments = I;
  for (int i = 0; i < 3; ++i) I[i] = moments[axis[i]];
  sense = I[0] < I[2] ? 1.0 : -1.0;

  // Axes 1 and 3 are turned so that L leans towards them.
  for (const int i : {0, 2}) {
    const double turn = direction[axis[i]] < 0.0 ? -1.0 : 1.0;
    axes_B.col(i) = turn * axes.col(axis[i]);
    l[i] = turn * direction[axis[i]];
  }
  axes_B.col(1) = axes_B.col(2).cross(axes_B.col(0));
  const double turn = axes_B.col(1).dot(axes.col(axis[1])) < 0.0 ? -1.0 : 1.0;
  l[1] = turn * direction[axis[1]];
}

void Polhode::measure(double excess) {
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
  s = std::sqrt(d) * excess / volume;
  s1 = std::sqrt(d1 * (d * squares[0] + d3 * squares[1])) / volume;
  s3 = std::sqrt(d3 * (d * squares[2] + d1 * squares[1])) / volume;
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

  constexpr double kWider = 1e-12;
  // The last factor covers rounding.
  return (0.5 * omega2 + std::sqrt(0.25 * omega2 * omega2 + most)) * (1.0 + kWider);
}

}  // namespace tumble
