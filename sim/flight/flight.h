// Chapter 4, flight: motion between events in closed form, where it has a simple one.
#pragma once

#include <optional>

#include "sim/body/rigid_body.h"

namespace tumble {

/// Centre of mass under a constant acceleration:  x = x0 + v0 t + ½ g t². World frame, SI.
struct Parabola {
  Vec3 x0 = Vec3::Zero();  ///< [m]
  Vec3 v0 = Vec3::Zero();  ///< [m/s]
  Vec3 g = Vec3::Zero();   ///< [m/s²]

  Vec3 position(double t) const { return x0 + t * (v0 + 0.5 * t * g); }
  Vec3 velocity(double t) const { return v0 + t * g; }
};

/// Attitude that is two steady rotations, one about an axis fixed in the world, one about an axis
/// fixed in the body:
///   q = exp(t precession) q0 exp(t spin_B),   ω = precession + R spin_B.
/// So turns a body that has two equal principal moments I₁ and a third I₃ about its axis e, free of
/// torque (Landau and Lifshitz, Mechanics, §33):
///   precession = L/I₁,   spin_B = (1/I₃ − 1/I₁)(L·e) e_B.
struct SymmetricRotor {
  Quat q0 = Quat::Identity();      ///< body to world at t = 0
  Vec3 precession = Vec3::Zero();  ///< [rad/s] world
  Vec3 spin_B = Vec3::Zero();      ///< [rad/s] body

  Quat attitude(double t) const;
  Vec3 omega(double t) const;  ///< [rad/s] world
};

/// One body's flight. t [s] counts from the instant it was made for; it may be negative.
struct Flight {
  Parabola parabola;
  SymmetricRotor rotor;

  Pose pose(double t) const { return {parabola.position(t), rotor.attitude(t)}; }
};

/// The flight that begins with the present state of a body under gravity [m/s²] alone, for
///   – a body whose inertia tensor is diagonal with two or three equal moments (to rounding),
///   – a fixed body, which moves on steadily.
/// @return nothing for any other body: its attitude takes elliptic functions.
std::optional<Flight> symmetricFlight(const RigidBody& body, const Vec3& gravity);

}  // namespace tumble
