// The instant at which two bodies in flight first touch: from the left, never past it.
//
// Seen along a direction n, a corner p of a and a corner q of b are  f = n·(p − q)  apart. With n
// turning steadily at Ω,
//   f(t+s) ≥ f + f′ s + ½ (n·a_rel − K) s²,   K = |Ω|² D + 2|Ω| V + B,
// where D and V bound |p − q| and |ṗ − q̇|, and B how far the turning of the bodies bends the paths
// of their corners (`Flight::accelBound`). As long as all these parabolas stay above zero, a plane
// lies between the bodies. One step goes to the first zero among them, and repeats with a new
// plane: no step passes the first touch. Ω follows the feature that n is tied to, so that at the
// end the steps are Newton's and close in quadratically. Conservative advancement: Mirtich,
// Impulse-based Dynamic Simulation of Rigid Body Systems, 1996, §2.3. Departure: the bound is of
// second order, and the plane may turn.
#pragma once

#include <optional>

#include "sim/collide/contact_point.h"
#include "sim/flight/flight.h"
#include "sim/flight/top.h"
#include "sim/shape/shape.h"

namespace tumble {

/// A body on its way.
struct Flyer {
  const Flight* flight = nullptr;
  const Parabola* path = nullptr;  ///< of the centre of mass, counted from t = 0
  const Shape* shape = nullptr;
  RigidBody* body = nullptr;      ///< overwritten: the body at the time last looked at
  const HeavyTop* top = nullptr;  ///< in place of flight and path
};

/// Two bodies on their way, not both half-spaces.
class Approach {
 public:
  /// @param touch  [m] bodies nearer than this at the start must part, or they touch already
  Approach(const Flyer& a, const Flyer& b, double touch);

  /// The first time [s] in [t0, t1) at which the bodies touch, if there is one.
  /// @param begins  the bodies may touch at t0, if they move apart from there
  std::optional<double> firstTouch(double t0, double t1, bool begins);

 private:
  /// Corners of a body along n: heights [m], and how fast they change [m/s].
  struct Heights {
    double at[8], rate[8];
    int count = 0;
  };

  void lookAt(double t);
  void placeCorners(double t);
  /// How long [s] the balls around the bodies keep apart for certain; 0 if they overlap.
  double ballStep() const;
  /// How long [s] the corners keep apart for certain, at most `limit`.
  double cornerStep(double limit, bool begins) const;
  double stepAlong(const Vec3& n, const Vec3& turn, double limit, bool begins) const;
  Heights heights(int side, const Vec3& n, const Vec3& rate) const;
  Vec3 planeTurn() const;

  struct Side {
    Flyer flyer;
    double radius = 0.0;   ///< [m] of the bounding ball
    double corner = 0.0;   ///< [m] distance of the corners from the centre
    double turning = 0.0;  ///< [1/s²] bound on |ω|² + |ω̇|
    double slack = 0.0;    ///< [m/s²] bound on what acceleration_ leaves out of the centre's
    double bend() const { return slack + corner * turning; }
    double round = 0.0;             ///< [m] radius about each corner
    Vec3 corners_B[8], corners[8];  ///< [m] from the centre; body frame, world
    Vec3 rates[8];                  ///< [m/s] of the corners against the centre
    int count = 0;
  };
  Side side_[2];                      ///< a, b
  const HalfSpace* plane_ = nullptr;  ///< b, if it is one
  double touch_;
  Vec3 acceleration_;  ///< [m/s²] of a's centre against b's; against the world if b is a plane

  // At the time last looked at.
  Vec3 offset_ = Vec3::Zero(), velocity_ = Vec3::Zero();  ///< of a's centre, as acceleration_
  double ballGap_ = 0.0;                                  ///< [m]
  Vec3 ballNormal_ = Vec3::UnitY();
  ContactPoint wide_;  ///< the widest plane
};

}  // namespace tumble
