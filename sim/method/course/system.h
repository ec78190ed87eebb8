// The course's Y' = f(t, Y): bodies under outer forces and the forces of their lasting contacts.
#pragma once

#include <span>
#include <vector>

#include "sim/contact/rest.h"
#include "sim/method/model.h"
#include "sim/ode/system.h"

namespace tumble {

/// What is integrated along with the bodies, at the end of Y, so that the books close to the order
/// of the integrator.
struct Ledger {
  double work = 0.0;            ///< [J] of forces without a potential, and of moving fixed bodies
  double friction = 0.0;        ///< [J] lost
  Vec3 impulse = Vec3::Zero();  ///< [N·s] of everything outside the bodies that move
};

/// Y = 13 numbers a body in scene order (slide SD11), then the five of the ledger.
class CourseSystem : public System {
 public:
  static constexpr int kLedgerSize = 5;

  /// @param contacts  lasting contacts; they are followed through every stage
  CourseSystem(const Model& model, std::span<const RigidBody> bodies, std::vector<Contact> contacts,
               double tau);

  int size() const override;
  void derivative(double t, std::span<const double> y, std::span<double> ydot) const override;
  bool offersKickDrift() const override { return true; }
  void kick(double t, double h, std::span<double> y) const override;
  void drift(double t, double h, std::span<double> y) const override;
  void normalise(std::span<double> y) const override;

  /// Bodies → Y, with an empty ledger.
  void pack(std::span<const RigidBody> bodies, std::span<double> y) const;
  /// Y → bodies.
  void unpack(std::span<const double> y, std::span<RigidBody> bodies) const;
  Ledger ledger(std::span<const double> y) const;

  /// Brings the contacts to these bodies and finds their forces; the bodies keep the sum of all.
  SolveReport findForces(std::span<RigidBody> bodies) const;
  const std::vector<Contact>& contacts() const { return contacts_; }

  /// Worst residual of the contact problems so far, and whether one was left unsolved.
  double residual() const { return residual_; }
  bool unsolved() const { return unsolved_; }

 private:
  const Model& model_;
  mutable std::vector<RigidBody> bodies_;
  mutable std::vector<Contact> contacts_;
  mutable RestForces rest_;
  mutable std::vector<double> rate_;
  mutable Vec3 outerForce_ = Vec3::Zero();
  mutable double residual_ = 0.0;
  mutable bool unsolved_ = false;
};

}  // namespace tumble
