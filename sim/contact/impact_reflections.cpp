// Generalized reflections: a blow runs through a chain of bodies, contact after contact.
#include "sim/contact/impact_pass.h"

namespace tumble {

ImpactReport impactReflections(const Impact& impact) {
  constexpr int kPasses = 10'000;  // a chain of n balls takes n; random heaps take tens
  return strikeUntilApart(impact, PassKind::Approaching, kPasses);
}

}  // namespace tumble
