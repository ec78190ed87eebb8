// Chapter 10, audit: what the audit takes from a method, and the way of a body between two such
// states.
#pragma once

#include <algorithm>
#include <cmath>

#include "sim/body/rigid_body.h"

namespace tumble {

/// What is recorded of a body at an instant: its state, and nothing that was derived from it. World
/// frame, SI.
struct Recorded {
  Vec3 x = Vec3::Zero();
  Quat q = Quat::Identity();
  Vec3 P = Vec3::Zero(), L = Vec3::Zero();

  bool operator==(const Recorded& o) const {
    return x == o.x && q.coeffs() == o.q.coeffs() && P == o.P && L == o.L;
  }
};

inline Recorded recordedOf(const RigidBody& body) {
  return {body.x, body.q, body.P, body.L};
}

/// ω [rad/s] = R IbodyInv Rᵀ L.
Vec3 spinOf(const RigidBody& constants, const Recorded& r);

/// ½ |P|²/M + ½ L·ω [J].
double kineticOf(const RigidBody& constants, const Recorded& r);

/// How far [m] a point within r [m] of the origin of a body can be from where it was.
inline double wayBetween(const Vec3& x0, const Quat& q0, const Vec3& x1, const Quat& q1, double r) {
  const double turn = std::min((q1.coeffs() - q0.coeffs()).squaredNorm(),
                               (q1.coeffs() + q0.coeffs()).squaredNorm());
  return (x1 - x0).norm() + 2.0 * r * std::sqrt(turn);
}

/// One instant of a way.
struct PathPoint {
  Vec3 x = Vec3::Zero();
  Quat q = Quat::Identity();
  Vec3 v = Vec3::Zero(), omega = Vec3::Zero();
};

/// The way of a body through a part of a step, from the states at its ends alone: the cubics that
/// meet places and velocities P/M, turns φ and their rates there, φ the rotation vector since the
/// start,
///   φ̇ = ω − ½ φ × ω + (1/12 + …) φ × (φ × ω).
/// Error h⁴ of a smooth motion. Where impulses at the start are a part of the step and its velocity
/// does not agree with the way – which goes on with that of the end then – the parabolas that meet
/// the end's. World frame, SI.
class BodyPath {
 public:
  /// @param h  [s] > 0
  /// @param struck  impulses may have acted right after `start`
  BodyPath(const RigidBody& constants, const Recorded& start, const Recorded& end, double h,
           bool struck);
  /// The way of a fixed body, which moves on steadily from `start`.
  BodyPath(const RigidBody& fixed, double h);

  PathPoint at(double share) const;

  /// How far [m] a point within r [m] of the origin may be from where `at` has it at share s:
  ///   s² (1 − s)² (C + r Γ)
  /// if the fourth terms of the series of place and turn are no larger than C and Γ, which are
  /// twice the third, or, as these may pass through zero, what the turn makes of the second:
  ///   C = max(2 |c₃|, |c₂| θ²/6),   c₃ = h (v₀ + v₁) − 2 Δx,   c₂ = ½ h (v₁ − v₀),
  /// Γ the same of φ. Forces on a body turn with it, so that θ² = h² |φ̇|² + 4 |γ₂|: a motion
  /// of rate λ has c₄ = c₂ (hλ)²/12, and what swings or tips by φ has γ₂ = ½ (hλ)² φ.
  double error(double share, double r) const;

  /// Whether the body turned by more than a radian: then nobody can tell which way.
  bool lost() const { return lost_; }

 private:
  Vec3 x0_, way_, u0_, u1_;  ///< [m] place, way, and h times the velocities at both ends
  Quat q0_;
  Vec3 turn_, w0_, w1_;  ///< [rad] φ at the end, and h times its rates at both ends
  double h_;
  bool lost_ = false;
};

}  // namespace tumble
