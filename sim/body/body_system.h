// Chapter 3, body: bodies under forces, as one system for the solvers of chapter 1.
#pragma once

#include <vector>

#include "sim/body/force.h"
#include "sim/ode/system.h"

namespace tumble {

/// Bodies that fly, free of contact: Y is 13 numbers a body, in order (slides SD22, SF21).
/// The bodies given at the start supply what is constant; their states enter through Y alone,
/// but for the v and omega of fixed bodies, which stay as they were given. World frame, SI.
class BodySystem : public System {
 public:
  BodySystem(const Vec3& gravity, std::vector<Force> forces, std::vector<RigidBody> bodies);

  int size() const override;
  void derivative(double t, std::span<const double> y, std::span<double> ydot) const override;

  bool offersKickDrift() const override { return true; }
  /// P += h F,  L += h τ, with the forces of this moment.
  void kick(double t, double h, std::span<double> y) const override;
  /// x += h v,  q = exp(h ω) q: the turn that q̇ = ½ (0, ω) q begins, exact for constant ω.
  void drift(double t, double h, std::span<double> y) const override;

  /// Unit quaternions.
  void normalise(std::span<double> y) const override;

  /// Y of the bodies' own states.
  void toArray(std::span<double> y) const;
  /// Y into the bodies, with all derived quantities.
  void fromArray(std::span<const double> y);
  std::span<const RigidBody> bodies() const { return bodies_; }

 private:
  void load(std::span<const double> y) const;

  Vec3 gravity_;
  std::vector<Force> forces_;
  mutable std::vector<RigidBody> bodies_;  // also where derivative and kick work
};

}  // namespace tumble
