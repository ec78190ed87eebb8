// Chapter 7, contact: lasting contacts that each keep to one mode, so that their forces are a
// smooth function of the motion and an integrator of any order can follow them.
#pragma once

#include <span>
#include <vector>

#include "sim/contact/contact.h"
#include "sim/problem/problem.h"

namespace tumble {

/// The unit vector along which a sliding contact slips: where its slip is too slow to tell, the
/// direction in which its sliding began, or the last stretch of it; and never turned against that,
/// so that forces stay smooth beyond the instant at which a slip ends.
/// The direction of a slip u that has just begun obeys a stiff equation, of rate mu f_n/(m |u|),
/// which keeps it where it grows: where u̇ is along it. Below the contact's onset u₀ it is taken as
///   e = d/|d|,   d = (1 − |u|/u₀) growth + u/u₀,
/// with the rate mu f_n/(m u₀). Friction deviates from the direction of growth, to first order, as
/// it would; the slip lags behind it by the part u₀/(mu f_n/m) of what it turns in a second.
Vec3 slipDirectionOf(const RigidBody& a, const RigidBody& b, const Contact& contact);

/// Forces of contacts that stick (u = 0), slide (u_n = 0, f_t = −mu f_n slip/|slip|), or are idle
/// (f = 0), u being relative accelerations:
///   J (M⁻¹ F λ + v̇*) + bias = 0,   f = F λ   with a column n − mu t of F for each that slides.
/// Equations and no inequalities: what the mode allows is for the caller to see. Where contacts
/// are more than needed, λ is that of springs (problem/solvers.h, solveNewton): −J δ with one small
/// motion δ of the bodies, which is the smallest where none slides. World frame, SI.
class ModeForces {
 public:
  /// Reads pose, velocity, force and torque of the bodies; sets `force` of every contact and adds
  /// it to the forces and torques. Contacts must have been followed to this pose.
  /// Where a slip has an onset, the direction of its growth is found anew.
  void apply(std::span<RigidBody> bodies, std::span<Contact> contacts);

  /// Moves the bodies by the least way, weighed by mass, that takes the separations of all that are
  /// not idle to what is granted them, to first order; then changes the velocities in the same
  /// manner until these neither approach nor part, nor slip if they stick. Follows the contacts.
  void project(std::span<RigidBody> bodies, std::span<Contact> contacts);

  /// Changes the velocities by the least impulses after which no contact approaches or parts, or
  /// slips if it sticks. @return those impulses on a [N·s], one for each contact
  std::vector<Vec3> still(std::span<RigidBody> bodies, std::span<const Contact> contacts);

  /// Σ n³ over all systems of n rows that were solved so far: what they cost, in proportion.
  double cubes() const { return cubes_; }

 private:
  /// As apply(), with growth as it is.
  void give(std::span<RigidBody> bodies, std::span<Contact> contacts);
  /// Turns the growth of contact k until the slip, at rest, would begin along it.
  void findGrowth(std::span<const RigidBody> bodies, std::span<Contact> contacts, std::size_t k);
  /// Rows of contact k, and the forces of their multipliers.
  void addRows(std::span<const RigidBody> bodies, const Contact& contact, bool tangential);
  /// λ in the range of J with  J M⁻¹ F λ = rhs_, for each heap of bodies on its own.
  void solve(std::span<const RigidBody> bodies);
  /// Per row: the lowest body that it is connected to through rows, fixed bodies apart.
  std::vector<int> heaps(std::span<const RigidBody> bodies) const;
  /// Gives the bodies λ: as a way, or as impulses.
  void push(std::span<RigidBody> bodies, bool velocities);
  bool anySlides(std::span<const std::size_t> own) const;
  /// J M⁻¹ Jᵀ of those rows.
  MatX mobility(std::span<const RigidBody> bodies, std::span<const std::size_t> own) const;
  double product(std::span<const RigidBody> bodies, const Row& row, const Row& force) const;

  std::vector<Row> rows_, forces_;  ///< J, and the columns of F
  std::vector<RigidBody> tried_;    ///< bodies under the forces of a growth that is tried
  MatX matrix_;
  VecX rhs_, lambda_;
  double cubes_ = 0.0;
};

/// How much of the push of a sliding contact is left to part its bodies, after its friction turned
/// them against each other:  n·W (n − mu t) / n·W n.  Not above 0 in the paradox of Painlevé.
double pushLeft(const RigidBody& a, const RigidBody& b, const Contact& contact);

}  // namespace tumble
