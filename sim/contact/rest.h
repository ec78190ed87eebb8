// Chapter 7, contact: the forces of lasting contacts (slides SD47–SD57).
#pragma once

#include <span>
#include <vector>

#include "sim/contact/bonds.h"
#include "sim/contact/contact.h"
#include "sim/problem/problem.h"

namespace tumble {

/// Finds the contact forces of all lasting contacts at one instant.
///
///   a = A f + b,   a ≥ 0,  f ≥ 0,  f·a = 0      (a: relative normal accelerations)
///
/// with A and b assembled from Jacobian rows as in Baraff, Rigid Body Simulation II, §9; friction
/// adds two rows a contact (sticking: Coulomb cone at acceleration level; sliding: −mu f_n against
/// the slip). Departure: b carries the pull of the contact, see `setPull`.
class RestForces {
 public:
  /// @param polished  to the last digits where there is friction, at any cost: for the instants at
  ///   which it is decided what sticks; else sweeps that start from the forces of a moment ago do
  explicit RestForces(bool polished = false) : polished_(polished) {}

  /// Reads pose, velocity, force and torque of the bodies, sets `force` of every lasting contact
  /// and adds the contact forces to force and torque. Contacts must have been followed to this
  /// pose. Bonds, if there are any, take part in the same problem, get their λ, and act.
  SolveReport apply(std::span<RigidBody> bodies, std::span<Contact> contacts,
                    Bonds* bonds = nullptr);

  /// Chooses the slip direction of creeping contacts for the next h seconds. The direction of a
  /// slow slip obeys a stiff equation (rate mu f_n/(m |slip|)), which an explicit integrator turns
  /// into chatter. So it is taken as at the end of the step: by Coulomb's law between the impulses
  /// of the step and the velocities v⁺ that they leave,  u = J⁺ v⁺ ≥ 0.  All that sticks is met by
  /// v⁺ = 0, however many rows there are. Bodies must carry their outer forces.
  /// @param ends  where the bodies get at their velocities in the step
  /// @param bonds  of `ends`; what their rows ask for beside u = J⁺ v⁺ counts for nothing
  void settleCreep(std::span<const RigidBody> bodies, std::span<const RigidBody> ends,
                   std::span<Contact> contacts, double h, const Bonds* bonds = nullptr);

 private:
  void addRows(std::span<const RigidBody> bodies, const Contact& contact);
  void addFrictionRows(std::span<const RigidBody> bodies, const Contact& contact);
  /// What was hard a moment ago is hard still: it begins with the forces of then, and takes what
  /// leaves hardly more than was left then.
  /// @param misfit  Bonds::misfit
  SolveReport solve(std::span<const Contact> contacts, double misfit);
  SolveReport solveAnew(bool friction, double misfit);
  Vec3 force(std::size_t contact) const;

  bool polished_, hard_ = false;
  double left_ = 0.0;  ///< residual of the last problem that was solved anew
  Problem problem_;
  Solution solution_;
};

/// Sets what draws the errors of a lasting contact back to zero, or to the overlap that it is
/// granted, with the time constant τ [s]:
///   pull = vrel (2/τ) + separation/τ²,   slipPull = slip/τ
/// as they are now. They hold for a stretch of motion: at the stages of an integrator bodies are
/// off the contact by what is no error, and a pull there would cost it its order.
void setPull(const RigidBody& a, const RigidBody& b, double tau, Contact& contact);

/// Direction of the slip of a sliding contact: along its slip now, but never turned against the
/// direction in which its sliding began, so that forces stay smooth through the instant of
/// sticking.
Vec3 slidingDirection(std::span<const RigidBody> bodies, const Contact& contact);

}  // namespace tumble
