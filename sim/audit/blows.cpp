// Whom a blow may have reached in a part of a step. A method strikes what meets within a step at
// its start, so that a body may be struck, strike another and be at rest again, and neither end of
// the part shows how fast it was. So what does not balance is asked again, with all in one group
// whom its energy could have carried to each other.
#include <algorithm>
#include <cmath>

#include "sim/audit/audit.h"

namespace tumble {
namespace {

/// Of the largest momentum, spin and kinetic energy: what is open by less is of no account.
constexpr double kAccount = 1e-6;

}  // namespace

/// Whether a group has what nothing gave it. Energy that a moving body may have given is not asked
/// for.
bool Audit::isOpen() const {
  if (!struck_) return false;
  return std::any_of(groups_.begin(), groups_.end(), [&](const Group& g) {
    if (g.count == 0 || g.lost) return false;
    const bool spun = !g.vague && g.L.norm() > kAccount * spinMax_;
    return (!isLed(g) && g.gain > kAccount * kineticMax_) ||
           (!g.held && !g.unseen && (spun || g.P.norm() > kAccount * momentumMax_));
  });
}

/// Lets bodies that may have touched others have any speed on the way that the energy of their
/// group allows: of any point within r of the origin v² ≤ 2 T (1/M + r²/I), by Cauchy and Schwarz.
/// @return whether more bodies may have touched so
bool Audit::passBlowsOn(const Nearness::Part& part) {
  carried_.assign(bodies_.size(), 0.0);
  blown_ = way_;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (moves(i))
      carried_[rootOf(i)] += kineticOf(bodies_[i], last_[i]) + kineticOf(bodies_[i], now_[i]);
  for (const int i : model_.solid) {
    if (!moves(i) || !pushed_[i]) continue;
    const double r = nearness_.radius(i);
    const double inverse = bodies_[i].invM + r * r * bodies_[i].IbodyInv.trace();
    blown_[i] = std::max(way_[i], h_ * std::sqrt(2.0 * carried_[rootOf(i)] * inverse));
  }
  return nearness_.seeFarther(part, blown_);
}

}  // namespace tumble
