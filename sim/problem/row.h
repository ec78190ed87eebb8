// Chapter 6, problem: what one row does at the velocities of its two bodies.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "sim/problem/problem.h"

namespace tumble {

/// J v + bias of one row.
inline double rowVelocity(const Row& row, std::span<const Vec6> v) {
  return rowSpeed(row, v[row.a], v[row.b]) + row.bias;
}

/// Diagonal entry of J M⁻¹ Jᵀ + C: how much u of the row changes per unit of its λ.
inline double rowMobility(const Problem& problem, const Row& row) {
  return (problem.invM[row.a] + problem.invM[row.b]) * row.linear.squaredNorm() +
         row.angularA.dot(problem.Iinv[row.a] * row.angularA) +
         row.angularB.dot(problem.Iinv[row.b] * row.angularB) + row.compliance;
}

/// Arm [m] at which a row that only turns bodies counts as a force does, √(1/(m w)) with w what its
/// λ turns and 1/m = 1/ma + 1/mb: λ over it is a force [N]. 1 for any other row.
inline double rowArm(const Problem& problem, const Row& row) {
  if (!row.linear.isZero(0.0)) return 1.0;
  const double invM = problem.invM[row.a] + problem.invM[row.b];
  const double turned = row.angularA.dot(problem.Iinv[row.a] * row.angularA) +
                        row.angularB.dot(problem.Iinv[row.b] * row.angularB);
  return invM > 0.0 && turned > 0.0 ? std::sqrt(invM / turned) : 1.0;
}

/// Sum of the sizes of all terms of J v + bias of one row.
inline double termsOf(const Row& row, std::span<const Vec6> v) {
  const Vec6 a = v[row.a].cwiseAbs(), b = v[row.b].cwiseAbs();
  return row.linear.cwiseAbs().dot(a.head<3>() + b.head<3>()) +
         row.angularA.cwiseAbs().dot(a.tail<3>()) + row.angularB.cwiseAbs().dot(b.tail<3>()) +
         std::abs(row.bias);
}

/// velocityScale, where the largest |u| of all rows and the largest sum of terms are known.
inline double velocityScale(double largest, double terms) {
  constexpr double kNothing = 1e8 * std::numeric_limits<double>::epsilon();
  largest = std::max(largest, kNothing * terms);
  return largest > 0.0 ? largest : 1.0;
}

}  // namespace tumble
