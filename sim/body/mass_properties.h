// Chapter 3, body: what a body weighs.
#pragma once

#include "sim/body/rigid_body.h"
#include "sim/shape/shape.h"

namespace tumble {

/// Mass, inertia tensor about the centre of mass, and where that centre is (slides SD19–SD20).
/// The slide's Ixx carries M/V in front of the integral, not M.
struct MassProperties {
  double mass = 1.0;                ///< [kg]
  Mat3 inertia = Mat3::Identity();  ///< [kg m²] body axes; Ixy = −∫ ρ x y dV
  Vec3 centre = Vec3::Zero();       ///< [m] in the frame in which the shape was given
};

/// Volume [m³] of a shape; infinity for a half-space, 0 for a particle.
double volume(const Shape& shape);

/// A solid of uniform density with the given mass [kg] > 0, in closed form:
///   sphere 2/5 m r²;  box m/12 (b² + c²), full edges;  cylinder ½ m r² about Y, m/12 (3r² + h²)
///   across;  capsule: the cylinder, m h/(h + 4/3 r), and two half-balls, each 2/5 m r² about Y,
///   m (2/5 r² + h²/4 + 3/8 h r) across;  hull and mesh: `integrate`;  compound: Σ Rᵢ Iᵢ Rᵢᵀ +
///   mᵢ (dᵢ² 1 − dᵢ dᵢᵀ), Steiner, with dᵢ from the common centre of mass to the part's;
///   particle 0.
/// @throws std::invalid_argument for a half-space, or if mass is not a positive finite number.
MassProperties solidMass(const Shape& shape, double mass);

/// The inverse of an inertia tensor; reciprocals where the body axes are principal, so that nothing
/// is lost.
Mat3 inverseInertia(const Mat3& I);

/// A body at rest at the origin with these mass properties.
/// @throws std::invalid_argument if mass is not positive and finite or inertia not symmetric and
/// positive definite.
RigidBody makeBody(const MassProperties& mass);

/// A point of mass [kg] at rest at the origin: no inertia, no turning (slides SD2–SD5).
/// @throws std::invalid_argument if mass is not positive and finite.
RigidBody makeParticle(double mass);

/// A body of infinite mass at a pose, moving on steadily with v [m/s] and omega [rad/s].
RigidBody makeFixedBody(const Pose& pose, const Vec3& v = Vec3::Zero(),
                        const Vec3& omega = Vec3::Zero());

}  // namespace tumble
