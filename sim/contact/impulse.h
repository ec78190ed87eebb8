// Chapter 7, contact: the impulse of one frictionless collision (slides SD41–SD46).
#pragma once

#include "sim/body/rigid_body.h"
#include "sim/collide/contact_point.h"

namespace tumble {

/// What one unit of impulse along `direction` at p changes in the relative velocity along it
/// [1/kg]:
///   k = 1/ma + 1/mb + d·((Ia⁻¹(ra×d))×ra) + d·((Ib⁻¹(rb×d))×rb)
/// World frame. 0 if both bodies are fixed.
double inverseEffectiveMass(const RigidBody& a, const RigidBody& b, const Vec3& p,
                            const Vec3& direction);

/// Size of the impulse by which two bodies obey Newton's impact law at one frictionless contact.
///   j = −(1 + e) vrel / k,   vrel = n·(ṗa − ṗb),   k as above with d = n
///   Baraff, Rigid Body Simulation II, §8. Departure: none.   World frame, SI.
/// @param a, b  bodies with Iinv current for this pose; a fixed body has zero inverse mass
/// @param c     p [m] on both surfaces; n [1], unit, out of b towards a
/// @param e     restitution [1] in [0, 1]
/// @return j ≥ 0 [N·s]: +j n to a, −j n to b, at p. 0 if they do not approach.
/// @throws std::invalid_argument if e is NaN or outside [0, 1].
double collisionImpulse(const RigidBody& a, const RigidBody& b, const ContactPoint& c, double e);

}  // namespace tumble
