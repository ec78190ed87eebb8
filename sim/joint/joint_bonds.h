// Chapter 8, joint: joints as rows of the four problems – rest, impact, step and displacement.
#pragma once

#include "sim/contact/bonds.h"
#include "sim/joint/joint.h"

namespace tumble {

/// A limit that is reached, as 2 · joint + (0 lower, 1 upper).
using Limit = int;

/// The rows of all joints at acceleration level, and of the limits that hold at this time:
///   J v̇ + J̇ v + (2/τ) rate + gap/τ² = 0,   of a limit ≥ 0, λ ≥ 0, complementary
/// with the pull towards zero of RestForces. λ is a force [N] or a torque [N m], free in sign.
/// @param tau  time constant τ [s] > 0 of the pull
void restBonds(std::span<const RigidBody> bodies, std::span<const Joint> joints,
               std::span<const Limit> limits, double tau, Bonds& bonds);

/// The rows of all joints for an impact, J v⁺ = 0, and of the limits that are reached: J v⁺ ≥ 0.
/// @param touch  [m] a limit nearer than this is reached
void impactBonds(std::span<const RigidBody> bodies, std::span<const Joint> joints, double touch,
                 Bonds& bonds);

/// The problem of the velocities next to those of the bodies, by their masses, that all joints
/// allow: J v = 0. Limits are left out.
void beginAllowedVelocities(std::span<const RigidBody> bodies, std::span<const Joint> joints,
                            Bonds& bonds, Problem& problem);

/// The rows of all joints for a step that moves bodies with the velocities at its end:
///   gap + h J v⁺ + ½ h² (J̇ v + J v̇) = 0,   of a limit ≥ 0
/// with v̇ of bodies that turn freely, ω̇ = −I⁻¹ (ω × L), so that after the step gaps are zero but
/// for terms in h³. Velocities should be what the joints allow: a slender body amplifies what they
/// do not. Limits beyond `touch` [m] that no body comes near in the step are left out.
/// @param vStar  velocities at the end of the step without λ, and what joints make of loads
void stepBonds(std::span<const RigidBody> bodies, std::span<const Joint> joints,
               std::span<const Vec6> vStar, double h, double touch, Bonds& bonds);

/// The rows of all joints for displacements that close their gaps:  gap + J Δ = 0, of a limit ≥ 0.
void liftBonds(std::span<const RigidBody> bodies, std::span<const Joint> joints, Bonds& bonds);

/// The limits that are reached and at rest: nearer than `touch` [m], no faster than the band
/// [m/s] – `keep` for those among `before`, else `rest`.
std::vector<Limit> restingLimits(std::span<const RigidBody> bodies, std::span<const Joint> joints,
                                 double touch, double rest, double keep,
                                 std::span<const Limit> before);

/// The fastest approach [m/s] < 0 to a limit that is reached; 0 if there is none.
double limitApproach(std::span<const RigidBody> bodies, std::span<const Joint> joints,
                     double touch);

/// What every joint exerts, from the λ of its rows at these poses.
/// @param h  [s] over which λ are impulses; 1 where they are forces
void jointForces(std::span<const RigidBody> bodies, std::span<const Joint> joints,
                 const Bonds& bonds, double h, std::vector<JointForce>& forces);

}  // namespace tumble
