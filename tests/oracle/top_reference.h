// A heavy top by extrapolation in any precision: knows the equations of Euler and Poisson.
#pragma once

#include <array>
#include <vector>

#include "sim/body/pivot.h"

namespace tumble::test {

/// Y = (ω_B, γ_B, q): angular velocity and the direction of gravity in the body, attitude.
///   Ip ω̇ = Ip ω × ω + M r_B × g γ,   γ̇ = γ × ω,   q̇ = ½ q (0, ω)
/// with the pivot's inertia Ip along the body axes and r_B from the pivot to the centre of mass.
template <class Scalar>
struct ReferenceTop {
  using State = std::array<Scalar, 10>;
  std::array<Scalar, 3> I, r;
  Scalar weight;  ///< M g

  State rate(const State& y) const {
    State f;
    const Scalar L[3] = {I[0] * y[0], I[1] * y[1], I[2] * y[2]};
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      f[i] = (L[j] * y[k] - L[k] * y[j] + weight * (r[j] * y[3 + k] - r[k] * y[3 + j])) / I[i];
      f[3 + i] = y[3 + j] * y[k] - y[3 + k] * y[j];
      f[7 + i] = (y[6] * y[i] + y[7 + j] * y[k] - y[7 + k] * y[j]) / 2;
    }
    f[6] = -(y[7] * y[0] + y[8] * y[1] + y[9] * y[2]) / 2;
    return f;
  }

  /// One step of h: the modified midpoint rule in 2, 4, … 24 parts, extrapolated to none (Gragg,
  /// Bulirsch and Stoer), of order 24.
  State step(const State& y, Scalar h) const {
    constexpr int kRows = 12;
    std::array<State, kRows> table;
    for (int row = 0; row < kRows; ++row) {
      const int parts = 2 * (row + 1);
      const Scalar part = h / parts;
      State before = y, now, f = rate(y);
      for (int i = 0; i < 10; ++i) now[i] = y[i] + part * f[i];
      for (int n = 1; n < parts; ++n) {
        f = rate(now);
        for (int i = 0; i < 10; ++i) {
          const Scalar next = before[i] + 2 * part * f[i];
          before[i] = now[i];
          now[i] = next;
        }
      }
      table[row] = now;
      for (int k = row - 1; k >= 0; --k) {
        const Scalar ratio = Scalar(row + 1) / (k + 1), weight = ratio * ratio - 1;
        for (int i = 0; i < 10; ++i)
          table[k][i] = table[k + 1][i] + (table[k + 1][i] - table[k][i]) / weight;
      }
    }
    return table[0];
  }
};

/// Attitude (w, x, y, z) of the top after `duration` [s] in that many steps. Gravity along −Y,
/// moments along the body axes.
template <class Scalar>
std::array<Scalar, 4> referenceTop(const RigidBody& body, const Pivot& pivot, double g,
                                   double duration, int steps) {
  using std::sqrt;
  ReferenceTop<Scalar> top;
  typename ReferenceTop<Scalar>::State y;
  Scalar q[4] = {body.q.w(), body.q.x(), body.q.y(), body.q.z()};
  const Scalar size = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (Scalar& part : q) part /= size;
  const Scalar R[3][3] = {{1 - 2 * (q[2] * q[2] + q[3] * q[3]), 2 * (q[1] * q[2] - q[0] * q[3]),
                           2 * (q[1] * q[3] + q[0] * q[2])},
                          {2 * (q[1] * q[2] + q[0] * q[3]), 1 - 2 * (q[1] * q[1] + q[3] * q[3]),
                           2 * (q[2] * q[3] - q[0] * q[1])},
                          {2 * (q[1] * q[3] - q[0] * q[2]), 2 * (q[2] * q[3] + q[0] * q[1]),
                           1 - 2 * (q[1] * q[1] + q[2] * q[2])}};
  const Scalar mass = body.M;
  Scalar arm2 = 0;
  for (int i = 0; i < 3; ++i) arm2 += Scalar(pivot.c_B[i]) * Scalar(pivot.c_B[i]);
  for (int i = 0; i < 3; ++i) {
    top.r[i] = -Scalar(pivot.c_B[i]);
    top.I[i] = Scalar(body.Ibody(i, i)) + mass * (arm2 - top.r[i] * top.r[i]);
    Scalar L = 0;
    for (int k = 0; k < 3; ++k) L += R[k][i] * Scalar(body.L[k]);
    y[i] = L / Scalar(body.Ibody(i, i));
    y[3 + i] = -R[1][i];
  }
  for (int i = 0; i < 4; ++i) y[6 + i] = q[i];
  top.weight = mass * Scalar(g);
  const Scalar h = Scalar(duration) / steps;
  for (int n = 0; n < steps; ++n) y = top.step(y, h);
  return {y[6], y[7], y[8], y[9]};
}

}  // namespace tumble::test
