// Chapter 4, flight: motion between events in closed form.
#pragma once

#include "sim/body/rigid_body.h"
#include "sim/flight/rotor.h"

namespace tumble {

/// Centre of mass under a constant acceleration:  x = x0 + v0 t + ½ g t². World frame, SI.
struct Parabola {
  Vec3 x0 = Vec3::Zero();  ///< [m]
  Vec3 v0 = Vec3::Zero();  ///< [m/s]
  Vec3 g = Vec3::Zero();   ///< [m/s²]

  Vec3 position(double t) const { return x0 + t * (v0 + 0.5 * t * g); }
  Vec3 velocity(double t) const { return v0 + t * g; }
};

/// The flight of one body from an instant on, free of torque and under a constant acceleration: a
/// parabola and a rotor. An evaluation takes the same short time for every t and allocates nothing.
/// World frame, SI.
class Flight {
 public:
  /// @param start         the body at t0, its derived quantities current; a fixed one moves on
  ///   steadily with its v and omega
  /// @param acceleration  [m/s²] of the centre of mass, constant; not used for a fixed body
  /// @param t0            [s] the instant that `start` shows
  Flight(const RigidBody& start, const Vec3& acceleration, double t0);

  /// Sets state and derived quantities of a body like the one given at the start to those at t [s].
  /// L keeps its bits.
  void at(double t, RigidBody& body) const;

  /// Where the body frame stands at t [s].
  Pose pose(double t) const;
  Quat attitude(double t) const;

  /// The way of the centre of mass, counted from `start`.
  const Parabola& path() const { return parabola_; }
  /// [s] the instant that the flight begins at.
  double start() const { return t0_; }

  /// A bound [m/s²] on the acceleration of every body point within r [m] of the centre of mass, for
  /// all time:  |a| + r (½ ω² + √(¼ ω⁴ + ω̇²)), the greatest ω and ω̇ on the way
  /// (`Polhode::turning`).
  double accelBound(double r) const;
  /// The part of it that the turning of the body gives, per metre [1/s²].
  double turning() const { return rotor_.turning(); }

 private:
  double t0_;
  Parabola parabola_;
  Rotor rotor_;
  Vec3 P0_, force_;  ///< [kg m/s], [N]: P = P0 + t force
  Vec3 L_;           ///< [kg m²/s]
  Quat q0_;          ///< the attitude at t0
};

}  // namespace tumble
