// What carries a body at one instant, if that is one plane that stands still, and how the body
// moves on it: Coulomb's law, tan θ = μ.
#pragma once

#include "app/claim/free_body.h"

namespace tumble {

/// A body that one plane carries, at one sample.
struct Footing {
  static constexpr double kStill = 1e-9;  ///< [m/s] slower than this nothing slides

  int ground = kNoBody;      ///< the body below it; none: it touches none, several, a moving one
  Vec3 n = Vec3::UnitY();    ///< [1] out of the ground
  Vec3 slip = Vec3::Zero();  ///< [m/s] of the points that touch
  Vec3 downhill = Vec3::Zero();  ///< [m/s²] gravity along the plane
  double into = 0.0;             ///< [m/s²] gravity into the plane
  double mu = 0.0;
  double mobility = 1.0;  ///< 1 + m r²/I of a ball: so much faster does friction change its slip

  bool slides() const { return slip.norm() > kStill; }
  bool holds() const { return downhill.norm() <= mu * into * mobility; }
  double degrees() const;  ///< of the plane
  /// Slip keeps its direction only along the steepest line, or where the plane is level.
  bool straight() const;
  /// Of the centre of mass [m/s²]: g sin θ less μ g cos θ against the slip; stuck, a block rests
  /// and a ball rolls with g sin θ/(1 + I/(m r²)).
  Vec3 acceleration() const;
  /// Until a slip that slows down has ended [s]; else infinity.
  double stops() const;
  /// The same footing when its slip has ended.
  Footing stuck() const;
};

/// What carries a body at a sample; `gravity` is its acceleration in free flight [m/s²]. No ground
/// if that is not one plane, or if a body other than a ball turns.
Footing footingOf(const Scene& scene, const Sample& sample, int body, const Vec3& gravity);

/// The first event [s] of a body after an instant; without one, at infinity.
Event nextEvent(const Recording& recording, int body, double t);

/// Velocities of stepping change once in so many seconds, and its events end there; of other
/// methods 0.
double grain(const Scene& scene);

}  // namespace tumble
