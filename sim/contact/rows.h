// Chapter 7, contact: contacts written as rows of the one problem.
#pragma once

#include <span>

#include "sim/contact/contact.h"
#include "sim/problem/problem.h"

namespace tumble {

/// The row  u = d·(ṗa − ṗb) + bias  of bodies ia and ib at world point p [m] along unit d.
inline Row pointRow(std::span<const RigidBody> bodies, int ia, int ib, const Vec3& p, const Vec3& d,
                    double bias) {
  const Vec3 armA = p - bodies[ia].x, armB = p - bodies[ib].x;
  return {.a = ia,
          .b = ib,
          .linear = d,
          .angularA = armA.cross(d),
          .angularB = -armB.cross(d),
          .bias = bias};
}

/// Empties the problem and writes inverse masses and inertias; vStar = twists of the bodies now.
void beginVelocityProblem(std::span<const RigidBody> bodies, Problem& problem);

/// The same with vStar = accelerations under each body's force and torque:
///   v̇ = F/m,  ω̇ = I⁻¹(τ − ω × L).  A fixed body keeps its velocity: 0.
void beginAccelerationProblem(std::span<const RigidBody> bodies, Problem& problem);

}  // namespace tumble
