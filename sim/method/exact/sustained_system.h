// The Y' = f(t, Y) of bodies whose contacts last and keep to their modes.
#pragma once

#include <span>
#include <vector>

#include "sim/body/body_system.h"
#include "sim/contact/modes.h"
#include "sim/method/effort.h"
#include "sim/method/model.h"

namespace tumble {

/// Y = the share of each body in scene order with momenta per mass and per inertia, so that light
/// bodies are followed as closely as heavy ones; then five numbers for the books.
class SustainedSystem : public System {
 public:
  SustainedSystem(const Model& model, std::span<const RigidBody> bodies);

  /// Begins a stretch of motion with these lasting contacts.
  void begin(std::span<const Contact> contacts) {
    contacts_.assign(contacts.begin(), contacts.end());
  }

  /// Balls look the same from all sides, so that of their attitude only what differs from a turn
  /// θ(t) is followed, which goes on from these bodies, at t = 0 s, with their spin ω₀ and, where
  /// their torque turns them about the same axis, with the acceleration α that it gives:
  ///   q(t) = exp(½ θ) r(t),   θ = ω₀ t + ½ α t²,   ṙ = ½ (exp(−½ θ) (ω − θ̇)) r.
  void turnFrom(std::span<const RigidBody> bodies);
  /// Y at t [s] of the stretch → bodies.
  void unpack(double t, std::span<const double> y, std::span<RigidBody> bodies) const;

  int size() const override { return static_cast<int>(unit_.size()); }
  void derivative(double t, std::span<const double> y, std::span<double> ydot) const override;
  /// Unit quaternions, no gaps, and velocities as the modes have them.
  void normalise(std::span<double> y) const override;

  /// Bodies → Y, with empty books.
  void pack(std::span<const RigidBody> bodies, std::span<double> y) const;
  /// Y → bodies, the turns θ of balls left out.
  void unpack(std::span<const double> y, std::span<RigidBody> bodies) const;

  /// What was integrated along with the bodies.
  struct Books {
    double work = 0.0;            ///< [J] of forces without a potential, and of moving fixed bodies
    double rubbed = 0.0;          ///< [J] lost to friction
    Vec3 impulse = Vec3::Zero();  ///< [N·s] of everything outside the bodies that move
  };
  Books books(std::span<const double> y) const;

  /// Sets the forces on these bodies, those of contacts left out.
  void outerForces(std::span<RigidBody> bodies) const { bodies_.sumForces(bodies); }
  /// Finds all forces on these bodies; the bodies keep the sum, contacts() their own.
  void findForces(std::span<RigidBody> bodies) const;
  const std::vector<Contact>& contacts() const { return contacts_; }
  long evaluations() const { return bodies_.evaluations(); }

  /// Where it is spent, nothing more is computed: rates are NaN.
  mutable Effort effort;

 private:
  static constexpr int kBooks = 5;
  struct Ball {
    std::size_t body = 0, slot = 0;                 ///< and where its r stands in Y
    Vec3 spin = Vec3::Zero(), rate = Vec3::Zero();  ///< ω₀ [rad/s], α [rad/s²]
  };
  Books rates() const;

  const Model& model_;
  BodySystem bodies_;
  std::vector<double> unit_;  ///< of each number of Y
  std::vector<Ball> balls_;
  mutable std::vector<RigidBody> work_;
  long moving_;                        ///< bodies that are not fixed
  mutable std::vector<double> plain_;  ///< Y in SI units
  mutable std::vector<Contact> contacts_;
  mutable ModeForces modes_;
  mutable Vec3 outerForce_ = Vec3::Zero();
};

}  // namespace tumble
