// Chapter 7, contact: what the impact laws that solve for many contacts at once have in common.
#pragma once

#include "sim/contact/impact.h"

namespace tumble {

/// Which of the reached contacts take part in a pass.
enum class PassKind {
  Touching,     ///< all that do not separate
  Approaching,  ///< those that approach, and those at rest that do not rebound
  Inelastic,    ///< all, and none rebounds
};

/// One pass over the contacts that the impact reaches:
///   n·v⁺ ≥ −e n·v⁻,  j ≥ 0,  complementary.
/// Contacts that already separate stay out, so that no pass can add energy: for those inside it
/// changes by ½ Σ j (1 − e) n·v⁻ ≤ 0. Where nothing rebounds, normal and friction impulses are one
/// problem, which takes energy whatever the friction; else the normal impulses come first and
/// friction, bounded by them, after.
void strikeOnce(const Impact& impact, PassKind kind, ImpactReport& report);

/// Newton's law at one contact, with what it does through bonds; then its friction.
void strikeOne(const Impact& impact, int contact, ImpactReport& report);

/// The least change of velocity, weighed by mass, after which all bonds hold. What it takes from
/// the energy counts as friction if that was what broke them, else as restitution.
void tighten(const Impact& impact, bool afterFriction, ImpactReport& report);

/// What a contact takes in compression.
struct Compressed {
  double j = 0.0;     ///< [N·s] along its normal
  double lost = 0.0;  ///< [J]; the sum over an island is what its bodies lost
};

/// The inelastic problem of some contacts, friction inside (1 + e) mu.
/// @param e       [1] per contact of the list
/// @param island  per contact of the list: none of them gains energy, however far the solver came
/// @return one for each contact of the list, and last a row for the bonds
std::vector<Compressed> compress(const Impact& impact, std::span<const int> contacts,
                                 std::span<const double> e, std::span<const int> island,
                                 ImpactReport& report);

/// Per contact of the list the number of its island, which bodies that can move join; bonds join
/// all.
std::vector<int> islandsOfContacts(const Impact& impact, std::span<const int> contacts);

/// Adds what one impact did to what others did.
void add(const ImpactReport& part, ImpactReport& sum);

/// Passes until nothing approaches; after so many, one more without rebound. What fixed bodies that
/// move close in on is struck at once if it takes long, and not at all if no impulses part it.
ImpactReport strikeUntilApart(const Impact& impact, PassKind kind, int passes);

/// Whether some contact still approaches, or a bond gives way.
bool anyApproaching(const Impact& impact);

}  // namespace tumble
