// Chapter 7, contact: contacts written as rows of the one problem.
#pragma once

#include <span>

#include "sim/contact/contact.h"
#include "sim/problem/problem.h"

namespace tumble {

/// (p − x) × d, or 0 where the arm lies along d but for the rounding of its ends: balls without
/// friction must not begin to turn.
inline Vec3 turnAbout(const Vec3& x, const Vec3& p, const Vec3& d) {
  constexpr double kRounding = 1e-15;
  const Vec3 turn = (p - x).cross(d);
  const double least = kRounding * (p.lpNorm<1>() + x.lpNorm<1>());
  if (turn.lpNorm<Eigen::Infinity>() <= least) return Vec3::Zero();
  return turn;
}

/// The row  u = d·(ṗa − ṗb) + bias  of bodies ia and ib, whose centres are at xa and xb [m], at
/// world point p [m] along unit d.
inline Row pointRow(int ia, int ib, const Vec3& xa, const Vec3& xb, const Vec3& p, const Vec3& d,
                    double bias) {
  return {.a = ia,
          .b = ib,
          .linear = d,
          .angularA = turnAbout(xa, p, d),
          .angularB = -turnAbout(xb, p, d),
          .bias = bias};
}

/// The same of bodies where they are.
inline Row pointRow(std::span<const RigidBody> bodies, int ia, int ib, const Vec3& p, const Vec3& d,
                    double bias) {
  return pointRow(ia, ib, bodies[ia].x, bodies[ib].x, p, d, bias);
}

/// Empties the problem and writes inverse masses and inertias; vStar = twists of the bodies now.
void beginVelocityProblem(std::span<const RigidBody> bodies, Problem& problem);

/// The same for one body more. @return its number in the problem
int addToVelocityProblem(const RigidBody& body, Problem& problem);

/// The same with vStar = accelerations under each body's force and torque:
///   v̇ = F/m,  ω̇ = I⁻¹(τ − ω × L).  A fixed body keeps its velocity: 0.
void beginAccelerationProblem(std::span<const RigidBody> bodies, Problem& problem);

}  // namespace tumble
