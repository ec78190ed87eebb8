// Chapter 3, body: a body that is held at one of its points, as a top is (Landau and Lifshitz,
// Mechanics, §35).
#pragma once

#include "sim/body/rigid_body.h"

namespace tumble {

/// The body point c_B, fixed at the world point p, and what follows from it. With r = x − p = −R
/// c_B the motion is a rotation about p:
///   v = ω × r,   H = L + r × P = Ip ω,   Ip = Ibody + M (|c|² 1 − c cᵀ)  (parallel axes).
struct Pivot {
  int body = 0;
  Vec3 c_B = Vec3::Zero();           ///< [m] from the centre of mass, body frame
  Vec3 p = Vec3::Zero();             ///< [m] world
  Mat3 Ibody = Mat3::Identity();     ///< [kg m²] Ip: inertia tensor about c_B, body frame
  Mat3 IbodyInv = Mat3::Identity();  ///< [1/(kg m²)] its inverse
};

/// The pivot at body point c_B [m] of a body as it stands; `body` is its index.
Pivot makePivot(const RigidBody& held, int body, const Vec3& c_B);

/// H [kg m²/s]: angular momentum about the pivot, world frame.
Vec3 momentumAbout(const Pivot& pivot, const RigidBody& body);

/// Puts the body where its q and its H, kept as they are, have it:
///   ω = Ip⁻¹ H,  x = p − R c,  P = M ω × r,  L = I ω.
void hold(const Pivot& pivot, const Vec3& H, RigidBody& body);

/// Force [N] of the pivot on the body that keeps c_B from accelerating, in closed form:
///   ω̇ = Ip⁻¹ (τ + r × F − ω × Ip ω),   reaction = M (ω̇ × r + ω × (ω × r)) − F,
/// with force F and torque τ about the centre of mass of everything else.
Vec3 reaction(const Pivot& pivot, const RigidBody& body);

/// Adds the reaction to force and torque of the body.
void addReaction(const Pivot& pivot, RigidBody& body);

}  // namespace tumble
