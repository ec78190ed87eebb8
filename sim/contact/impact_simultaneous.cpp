// Newton's impact law at all contacts at once, as a linear complementarity problem.
#include "sim/contact/impact_pass.h"

namespace tumble {

ImpactReport impactSimultaneous(const Impact& impact) {
  constexpr int kPasses = 20;
  return strikeUntilApart(impact, PassKind::Touching, kPasses);
}

}  // namespace tumble
