// Chapter 7, contact: what happens to all bodies at the instant of a collision (slides SD36–SD45).
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "sim/contact/bonds.h"
#include "sim/contact/contact.h"

namespace tumble {

/// Where the energy of an impact went [J], and how well it was solved.
struct ImpactReport {
  double lostNormal = 0.0;  ///< taken by restitution < 1
  double lostFriction = 0.0;
  double work = 0.0;               ///< done on the others by fixed bodies that move
  double cut = 0.0;                ///< restitution held back, that would have added energy
  double residual = 0.0;           ///< worst natural-map residual
  bool finishedInelastic = false;  ///< the passes ran out; the last one took e = 0
  long rows = 0;                   ///< that solvers and sweeps went over: what it cost
};

/// The contacts struck at one instant, and what they get.
struct Impact {
  std::span<RigidBody> bodies;
  /// All that touch. Those that are lasting, and move no faster than such may, rest beside a hit.
  std::span<const Contact> contacts;
  std::span<const double> restitution;  ///< [1] per contact, for this instant
  std::span<Vec3> impulse;              ///< [N·s] out: on a, per contact, friction included
  ContactTolerance tolerance;
  /// Rows that hold at the end of every pass, u = 0 or u ≥ 0; their λ adds up. Null: none.
  Bonds* bonds = nullptr;
  /// Whether a contact problem follows at once that stops what a law for crowds leaves approaching.
  bool goesOn = false;

  bool bound() const { return bonds && !bonds->empty(); }
};

/// A row of the table of impact laws. Changes P and L (and what is derived) of the bodies until no
/// contact approaches any more. Never gains energy.
struct ImpactLaw {
  std::string_view name;
  std::string_view summary;
  ImpactReport (*apply)(const Impact&);
};

/// All impact laws. To add one: write `sim/contact/impact_<name>.cpp` and add its row in
/// impact.cpp.
std::span<const ImpactLaw> impactLaws();
const ImpactLaw* findImpactLaw(std::string_view name);

/// Newton's law for all contacts at once:  n·v⁺ ≥ −e n·v⁻,  j ≥ 0,  complementary. A brick that
/// lands flat leaves flat. Repeated while friction or a break-away leaves a contact approaching.
ImpactReport impactSimultaneous(const Impact& impact);

/// Newton's law at the contacts that approach, all at once, until none does: elastic impacts are
/// reflections of the velocity of the whole heap, and a blow runs through a row of balls to the
/// last. Keeps energy (e = 1), momentum and symmetry; bodies can break away; impulses only push.
///   Smith, Kaufman, Vouga, Tamstorf, Grinspun, Reflections on Simultaneous Impact, 2012, §5.
///   Departure: each contact has its own e; contacts at rest that do not rebound take part at once.
ImpactReport impactReflections(const Impact& impact);

/// Poisson's law: an inelastic impact takes j_c; then every contact gives e j_c back, and what
/// still approaches is stopped. Where unlike e would add energy, all give back the same smaller
/// share.
///   Glocker and Pfeiffer, Multiple impacts with friction in rigid multibody systems, 1995.
ImpactReport impactPoisson(const Impact& impact);

/// Poisson's law for crowds: one inelastic problem of all that the blow reaches; then the contacts
/// that approached give e j back along their normals, and those that rested or parted the mean e of
/// them, but no more, island by island, than leaves the energy that there was. What approaches
/// after that takes another blow, here or by the caller. A blow costs two or three problems,
/// however many bodies it runs through. With e = 1 and without friction it keeps the energy; it
/// cannot tell the bodies of a row that touches apart, all of which leave alike.
///   Guendelman, Bridson, Fedkiw, Nonconvex rigid bodies with stacking, 2003, §5. Departure: e j in
///   place of −e vrel, so that no energy is gained; friction of both phases is found in the first,
///   inside (1 + e) mu.
ImpactReport impactCrowd(const Impact& impact);

/// `reflections` as far as a blow reaches kReflectionsReach contacts; beyond, `crowd`, one island
/// of contacts after the other.
ImpactReport impactAuto(const Impact& impact);

/// Contacts that a blow may reach before reflections, pass after pass through all of them, cost
/// more than the steps do.
inline constexpr int kReflectionsReach = 64;

/// What the contacts of one pair count for there: those that rub side by side take hundreds of
/// sweeps a pass to share their friction.
inline int weightOfContacts(int contacts, double friction) {
  constexpr int kRubbing = 4;
  return contacts > 1 && friction > 0.0 ? kRubbing * contacts : contacts;
}

/// Newton's law for one contact at a time, the fastest approach first (slide SD46).
ImpactReport impactSequential(const Impact& impact);

/// Contacts that a collision can reach: those connected to an approaching one, or to a bond that
/// gives way, through bonds and bodies that can move. Ascending indices into impact.contacts; empty
/// if nothing approaches.
std::vector<int> reachOfImpact(const Impact& impact);

/// What an impulse did to the energy [J]: taken from the bodies, and given by fixed bodies that
/// move.
struct ImpulseEnergy {
  double lost = 0.0, work = 0.0;
  long rows = 0;  ///< gone over to find it
};

/// Gives J [N·s] to a and −J to b of a contact, at its point, and adds it to impact.impulse.
ImpulseEnergy applyContactImpulse(const Impact& impact, int contact, const Vec3& J);

/// Coulomb friction of an impact, after the normal impulses j [N·s] of the listed contacts: the
/// tangential impulses |jt| ≤ mu j that leave the least kinetic energy. Adds to impact.impulse.
ImpulseEnergy frictionImpulses(const Impact& impact, std::span<const int> contacts,
                               std::span<const double> j);

}  // namespace tumble
