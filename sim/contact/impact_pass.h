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

/// Passes until nothing approaches; after so many, one more without rebound.
ImpactReport strikeUntilApart(const Impact& impact, PassKind kind, int passes);

/// Whether some contact still approaches, or a bond gives way.
bool anyApproaching(const Impact& impact);

}  // namespace tumble
