// The course's Y' = f(t, Y): bodies under outer forces and the forces of their contacts.
#pragma once

#include <span>
#include <vector>

#include "sim/body/body_system.h"
#include "sim/method/course/contact_model.h"
#include "sim/method/effort.h"

namespace tumble {

/// What is integrated along with the bodies, at the end of Y, so that the books close to the order
/// of the integrator.
struct Ledger {
  double work = 0.0;            ///< [J] of forces without a potential, and of moving fixed bodies
  double taken = 0.0;           ///< [J] by contacts: lost to friction; to springs, stored too
  Vec3 impulse = Vec3::Zero();  ///< [N·s] of everything outside the bodies that move
};

/// Y = the share of each body in scene order (slide SD11), as `BodySystem` has it, then the five
/// numbers of the ledger.
class CourseSystem : public System {
 public:
  static constexpr int kLedgerSize = 5;

  CourseSystem(const Model& model, std::span<const RigidBody> bodies);

  /// Begins a stretch of motion with these lasting contacts, and limits of joints that hold.
  void begin(const std::vector<Contact>& contacts, const std::vector<Limit>& limits);

  int size() const override { return bodies_.size() + kLedgerSize; }
  void derivative(double t, std::span<const double> y, std::span<double> ydot) const override;
  /// What contacts leave of what the bodies offer.
  Offers offers() const override;
  void kick(double t, double h, std::span<double> y) const override;
  void drift(double t, double h, std::span<double> y) const override;
  void jet(double t, std::span<const double> y, int order,
           std::span<double> coefficients) const override;
  int algebraSize() const override { return bodies_.algebraSize() + kLedgerSize; }
  void algebra(double t, std::span<const double> y, std::span<double> a) const override;
  void commutator(std::span<const double> a, std::span<const double> b,
                  std::span<double> out) const override;
  void act(std::span<const double> a, std::span<double> y) const override;
  void normalise(std::span<double> y) const override;

  /// Bodies → Y, with an empty ledger.
  void pack(std::span<const RigidBody> bodies, std::span<double> y) const;
  /// Y → bodies.
  void unpack(std::span<const double> y, std::span<RigidBody> bodies) const;
  Ledger ledger(std::span<const double> y) const;

  /// Finds all forces on these bodies, those of contacts too; the bodies keep the sum.
  SolveReport findForces(std::span<RigidBody> bodies) const;
  const std::vector<Contact>& contacts() const { return contacts_->contacts(); }
  /// Of the same moment.
  std::vector<JointForce> jointForces(std::span<const RigidBody> bodies) const {
    std::vector<JointForce> forces;
    tumble::jointForces(bodies, model_.joints, contacts_->bonds(), 1.0, forces);
    return forces;
  }

  /// Worst residual of the contact problems of this stretch, and whether one was left unsolved.
  double residual() const { return residual_; }
  bool unsolved() const { return unsolved_; }
  /// Where it is spent, nothing more is computed: rates are NaN.
  mutable Effort effort;
  /// Evaluations of all forces since the system was made.
  long evaluations() const { return bodies_.evaluations(); }

 private:
  /// Y into work_, with all forces.
  void load(std::span<const double> y) const;
  /// Rates of the ledger while work_ is as loaded, but for the power of outer forces.
  Ledger contactRates() const;
  /// P [kg m/s] of all bodies with a pivot in work_.
  Vec3 heldMomentum() const;

  const Model& model_;
  BodySystem bodies_;
  mutable std::vector<RigidBody> work_;
  long moving_;                       ///< bodies that are not fixed
  mutable std::vector<double> half_;  ///< Y half-way through a drift
  std::unique_ptr<ContactForces> contacts_;
  mutable Vec3 outerForce_ = Vec3::Zero();
  mutable double residual_ = 0.0;
  mutable bool unsolved_ = false;
};

}  // namespace tumble
