// The instant at which two convex solids in flight first touch: from the left, never past it.
//
// Seen along a direction n, a point p of a and a point q of b are  f = n·(p − q)  apart. With n
// turning steadily at Ω,
//   f(t+s) ≥ f + f′ s + ½ c s²,   c = n·a_rel − K,   K = |Ω|² D + 2|Ω| V + B,
// where D and V bound |p − q| and |ṗ − q̇|, and B how far the turning of the bodies bends the paths
// of their points (`Flight::accelBound`). As long as the lowest of all these parabolas, c taken as
// negative, stays above zero, a plane lies between the bodies. Their lowest is a concave function
// of s, whose only zero is found by stepping down the parabolas from the right. One step goes
// there, and repeats with a new plane: no step passes the first touch. Ω follows the feature that n
// is tied to, so that at the end the steps are Newton's and close in quadratically. Conservative
// advancement: Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996, §2.3.
// Departure: the bound is of second order, and the plane may turn.
#pragma once

#include <optional>
#include <span>

#include "sim/collide/contact_point.h"
#include "sim/collide/rim.h"
#include "sim/flight/flight.h"
#include "sim/flight/top.h"
#include "sim/shape/outline.h"

namespace tumble {

/// A convex part of a body on its way.
struct Flyer {
  const Flight* flight = nullptr;
  const Convex* convex = nullptr;
  RigidBody* body = nullptr;      ///< overwritten: the body at the time last looked at
  double* when = nullptr;         ///< [s] which is that, where more than one part shares the body
  const HeavyTop* top = nullptr;  ///< in place of the flight
};

/// Two of them, not both half-spaces.
class Approach {
 public:
  /// @param touch  [m] bodies that hover nearer than this for long count as touching
  Approach(const Flyer& a, const Flyer& b, double touch);

  /// The first time [s] in [t0, t1) at which they touch, if there is one.
  /// @param begins  they may touch at t0, to rounding, if they part from there. Whether they do is
  ///   told by where they are after an instant in which they cannot move by more than rounding.
  std::optional<double> firstTouch(double t0, double t1, bool begins);

  /// How often places and planes were looked at so far.
  int evaluations() const { return evaluations_; }

 private:
  /// Outermost point of a side along a turning direction: height [m] and its rate [m/s].
  struct Reach {
    double at = 0.0, rate = 0.0;
  };
  struct Side {
    Flyer flyer;
    double turning =
        0.0;             ///< [1/s²] bound on the acceleration of points, per metre from the centre
    double slack = 0.0;  ///< [m/s²] bound on what acceleration_ leaves out of the centre's
    double corner = 0.0, round = 0.0;  ///< [m] as in the outline; 0 for a half-space
    bool isPoint = true;               ///< one outermost point: a ball, or a half-space
    double bend() const { return slack + corner * turning; }
  };
  /// The directions n and ṅ in the body frame of a side, the turning of the body taken off.
  struct Seen {
    Vec3 n, rate;
  };

  void lookAt(double t);
  void place(double t);
  void findPlane();
  /// How long [s] the balls around the bodies keep apart for certain; 0 if they overlap.
  double ballStep() const;
  /// Whether a plane that does not turn keeps the bodies apart for `limit` [s], as one soon found
  /// tells.
  bool staysApart(double limit) const;
  /// How long [s] the bodies keep apart for certain, at most `limit`.
  double cornerStep(double limit, bool begins) const;
  double stepAlong(const Vec3& n, const Vec3& turn, double limit, bool begins) const;
  Seen see(const Side& side, const Vec3& n, const Vec3& turn) const;
  /// The outermost point along `sign` (n + s ṅ).
  Reach outermost(const Side& side, const Seen& seen, double s, double sign) const;
  Vec3 planeTurn() const;
  Vec3 edgeTurn(const Vec3& e, const Vec3& omega, const Vec3& other, double round,
                const RimPoint& rim) const;
  Vec3 capTurn() const;
  double stepTurning(const Vec3& turn, double steady, double limit, bool begins) const;
  double fall() const;
  double speedWithin(double limit) const;
  double bound(const Vec3& n, double spin, double limit) const;
  bool isExact() const;

  Side side_[2];                      ///< a, b
  const HalfSpace* plane_ = nullptr;  ///< b, if it is one
  double touch_, size_;               ///< [m]
  Vec3 acceleration_;  ///< [m/s²] of a's centre against b's; against the world if b is a plane
  int evaluations_ = 0;

  // At the time last looked at.
  Vec3 offset_ = Vec3::Zero(), velocity_ = Vec3::Zero();  ///< of a's centre, as acceleration_
  double ballGap_ = 0.0;                                  ///< [m]
  Vec3 ballNormal_ = Vec3::UnitY();
  ContactPoint wide_;  ///< the widest plane
};

/// All parts of a body on its way; `body` is overwritten.
struct FlyingBody {
  const Flight& flight;
  std::span<const Convex> parts;
  RigidBody& body;
};

/// The first time [s] in [0, h) at which any part of one touches any of the other; h if there is
/// none. They may touch at 0, if they part from there.
/// @param touch  as of Approach [m]
double firstTouch(const FlyingBody& a, const FlyingBody& b, double touch, double h);

}  // namespace tumble
