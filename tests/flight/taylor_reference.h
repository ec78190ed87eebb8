// A free body by Taylor series in any precision: knows Euler's equations and nothing else.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "sim/body/rigid_body.h"

namespace tumble::test {

/// Eleven bits more than a double: enough to see the rounding of one. tests/oracle takes quadruple
/// precision.
using Extended = long double;

/// A body that turns freely, along its principal axes: moments, angular momentum in the body,
/// attitude (w, x, y, z) of unit length.
template <class Scalar>
struct FreeTop {
  std::array<Scalar, 3> I, L;
  std::array<Scalar, 4> q;
};

/// The body's state as it stands, widened without rounding; its inertia must be diagonal.
template <class Scalar>
FreeTop<Scalar> freeTop(const RigidBody& body) {
  using std::sqrt;
  FreeTop<Scalar> top;
  const Quat& q = body.q;
  const Scalar w = q.w(), u[3] = {q.x(), q.y(), q.z()};
  const Scalar uu = u[0] * u[0] + u[1] * u[1] + u[2] * u[2], qq = w * w + uu, norm = sqrt(qq);
  const Scalar uL = u[0] * Scalar(body.L[0]) + u[1] * Scalar(body.L[1]) + u[2] * Scalar(body.L[2]);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Scalar across = u[j] * Scalar(body.L[k]) - u[k] * Scalar(body.L[j]);
    top.I[i] = body.Ibody(i, i);
    top.L[i] = ((w * w - uu) * Scalar(body.L[i]) + 2 * (u[i] * uL - w * across)) / qq;
  }
  top.q = {w / norm, u[0] / norm, u[1] / norm, u[2] / norm};
  return top;
}

/// The top after `duration` [s]: L̇ = L × ω, q̇ = ½ q (0, ω), ω = I⁻¹ L, by Taylor series of order 36
/// in steps so long that the last two terms are below 1e-33.
template <class Scalar>
FreeTop<Scalar> taylorFlight(FreeTop<Scalar> top, Scalar duration) {
  using std::abs;
  using std::pow;
  constexpr int kOrder = 36;
  using Row = std::array<Scalar, kOrder + 1>;
  std::array<Row, 3> L, w;
  std::array<Row, 4> q;
  for (Scalar left = duration; left > 0;) {
    for (int i = 0; i < 3; ++i) L[i][0] = top.L[i];
    for (int i = 0; i < 4; ++i) q[i][0] = top.q[i];
    for (int n = 0; n < kOrder; ++n) {
      for (int i = 0; i < 3; ++i) w[i][n] = L[i][n] / top.I[i];
      const auto product = [n](const Row& a, const Row& b) {
        Scalar sum = 0;
        for (int k = 0; k <= n; ++k) sum += a[k] * b[n - k];
        return sum;
      };
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        L[i][n + 1] = (product(L[j], w[k]) - product(L[k], w[j])) / (n + 1);
        q[i + 1][n + 1] =
            (product(q[0], w[i]) + product(q[j + 1], w[k]) - product(q[k + 1], w[j])) /
            (2 * (n + 1));
      }
      q[0][n + 1] =
          -(product(q[1], w[0]) + product(q[2], w[1]) + product(q[3], w[2])) / (2 * (n + 1));
    }
    // The step from the last two terms, relative to |L| and to |q| = 1.
    Scalar size = 0;
    for (int i = 0; i < 3; ++i) size += abs(top.L[i]);
    Scalar h = left;
    for (const int n : {kOrder - 1, kOrder}) {
      Scalar last = 0;
      for (int i = 0; i < 3; ++i) last += abs(L[i][n]) / size;
      for (int i = 0; i < 4; ++i) last += abs(q[i][n]);
      const double longest = std::pow(1e-33 / static_cast<double>(last), 1.0 / n);
      if (last > 0 && h > longest) h = longest;
    }
    const auto at = [h](const Row& a) {
      Scalar sum = a[kOrder];
      for (int n = kOrder - 1; n >= 0; --n) sum = sum * h + a[n];
      return sum;
    };
    for (int i = 0; i < 3; ++i) top.L[i] = at(L[i]);
    for (int i = 0; i < 4; ++i) top.q[i] = at(q[i]);
    left -= h;
  }
  return top;
}

/// Angle [rad] between a reference attitude and one in double precision, taken as it stands.
template <class Scalar>
double angleTo(const std::array<Scalar, 4>& a, const Quat& b) {
  using std::sqrt;
  const Scalar w = b.w(), x = b.x(), y = b.y(), z = b.z();
  const Scalar across[3] = {a[0] * x - a[1] * w - a[2] * z + a[3] * y,
                            a[0] * y - a[2] * w - a[3] * x + a[1] * z,
                            a[0] * z - a[3] * w - a[1] * y + a[2] * x};
  const Scalar square = across[0] * across[0] + across[1] * across[1] + across[2] * across[2];
  return 2.0 * static_cast<double>(sqrt(square));
}

}  // namespace tumble::test
