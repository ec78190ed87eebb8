// Chapter 3, body: bodies under forces, as one system for the solvers of chapter 1.
#pragma once

#include <vector>

#include "sim/body/body_jet.h"
#include "sim/body/force.h"
#include "sim/body/free_turn.h"
#include "sim/body/pivot.h"
#include "sim/ode/system.h"

namespace tumble {

/// Bodies that fly, free of contact: Y is 13 numbers a body, 6 a particle, in order (slides SD22,
/// SF21). The bodies given at the start supply what is constant; their states enter through Y
/// alone, but for the v and omega of fixed bodies, which stay as they were given. World frame, SI.
class BodySystem : public System {
 public:
  BodySystem(const Vec3& gravity, std::vector<Force> forces, std::vector<RigidBody> bodies,
             std::vector<Pivot> pivots = {}, Attitude attitude = Attitude::Quaternion);

  int size() const override { return offset_.back(); }
  void derivative(double t, std::span<const double> y, std::span<double> ydot) const override;

  /// A kick and a drift, rough if a force depends on velocities, exact if no body tumbles; a jet if
  /// `BodyJet` covers the forces. The attitude as a matrix has the action of the group alone.
  Offers offers() const override;
  /// P += h F,  L += h τ, with the forces of this moment.
  void kick(double t, double h, std::span<double> y) const override;
  /// x += h v, and the free turn of each body with its L as it is.
  void drift(double t, double h, std::span<double> y) const override;

  /// Coefficients of all bodies; those of order k begin at k · (length of `coefficients`/(order +
  /// 1)).
  void jet(double t, std::span<const double> y, int order,
           std::span<double> coefficients) const override;
  /// Coefficient k of the power of the forces without potential in the last jet.
  double jetPower(int k) const { return jet_.power(k); }
  /// Coefficient k of the momentum of all bodies in the last jet.
  Vec3 jetMomentum(int k) const;

  /// An increment is 12 numbers a body, 6 a particle: (Δx, w, ΔP, ΔL) takes (x, q, P, L) to
  /// (x + Δx, exp(w) q, P + ΔP, L + ΔL). Of the commutators only [w₁, w₂] = w₁ × w₂ is not zero.
  int algebraSize() const override;
  void algebra(double t, std::span<const double> y, std::span<double> a) const override;
  void commutator(std::span<const double> a, std::span<const double> b,
                  std::span<double> out) const override;
  void act(std::span<const double> a, std::span<double> y) const override;

  /// Unit quaternions, and pivots where they belong.
  void normalise(std::span<double> y) const override;

  /// Y of the bodies' own states, or of those of the same bodies elsewhere.
  void toArray(std::span<double> y) const { toArray(bodies_, y); }
  void toArray(std::span<const RigidBody> bodies, std::span<double> y) const;
  /// Y into the bodies, with all derived quantities.
  void fromArray(std::span<const double> y) const { fromArray(y, bodies_); }
  void fromArray(std::span<const double> y, std::span<RigidBody> bodies) const;
  std::span<const RigidBody> bodies() const { return bodies_; }
  /// How often forces were summed so far: once a derivative, a kick or an increment; a jet counts
  /// its order, a drift nothing.
  long evaluations() const { return evaluations_; }

  // What `derivative` and `kick` are made of, for a system that adds forces of its own.
  /// Sets force and torque of the given bodies: gravity, the listed forces, reactions of pivots.
  void sumForces(std::span<RigidBody> bodies) const;
  /// dY/dt of the given bodies from their forces.
  void rates(std::span<const RigidBody> bodies, std::span<double> ydot) const;
  /// The increment per second of the given bodies from their forces.
  void increments(std::span<const RigidBody> bodies, std::span<double> a) const;
  /// P += h F,  L += h τ, with the forces that the given bodies, which Y describes, carry.
  void push(double h, std::span<RigidBody> bodies, std::span<double> y) const;

 private:
  /// One body's share of Y.
  template <class Number>
  std::span<Number> share(std::span<Number> y, std::size_t body) const {
    return y.subspan(offset_[body], offset_[body + 1] - offset_[body]);
  }

  Vec3 gravity_;
  std::vector<Force> forces_;
  mutable std::vector<RigidBody> bodies_;  // also where the functions above work
  std::vector<Pivot> pivots_;
  std::vector<int> pivotOf_;     ///< per body: its pivot, or −1
  std::vector<FreeTurn> turns_;  ///< per body, about its pivot if it has one
  std::vector<int> offset_;      ///< where each body's share of Y begins, and the end of all
  Attitude attitude_;
  mutable BodyJet jet_;
  mutable long evaluations_ = 0;
};

}  // namespace tumble
