// Chapter 8, joint: what holds two bodies together, as equality rows of the one problem (slide
// SD57).
#pragma once

#include <span>

#include "sim/body/rigid_body.h"
#include "sim/problem/problem.h"

namespace tumble {

/// One point of a and one of b coincide: a hinge in the plane, a ball and socket in space.
struct BallJoint {
  int a = 0, b = 0;
  Vec3 anchorA_B = Vec3::Zero(), anchorB_B = Vec3::Zero();  ///< [m] body frames
};

/// One point of a and one of b keep their distance: a massless rod with balls at its ends.
struct DistanceJoint {
  int a = 0, b = 0;
  Vec3 anchorA_B = Vec3::Zero(), anchorB_B = Vec3::Zero();  ///< [m] body frames
  double length = 1.0;                                      ///< [m] > 0
};

/// How far a joint is from being met [m]: |pa − pb|, or |pa − pb| − length.
double gap(std::span<const RigidBody> bodies, const BallJoint& joint);
double gap(std::span<const RigidBody> bodies, const DistanceJoint& joint);

/// Appends the rows of a joint at acceleration level, each with its own Equality cone:
///   u = d·(p̈a − p̈b) + bias = 0,   d along x, y, z, or along the rod.
/// The bias holds what does not come from accelerations: ω×(ω×r) of both ends and, for the rod,
/// |Δṗ across it|²/length. λ is then the force [N] on a along d: free in sign, it pushes or pulls.
void addRows(std::span<const RigidBody> bodies, const BallJoint& joint, Problem& problem);
void addRows(std::span<const RigidBody> bodies, const DistanceJoint& joint, Problem& problem);

}  // namespace tumble
