// Poisson's impact law for crowds: one problem for compression, one share of it given back.
//   v_c = v⁻ + M⁻¹ Jᵀ j_c,   v⁺ = v_c + M⁻¹ Jᵀ e j_c
// Where one e holds for all that hits, and nothing rubs, v⁺ = v_c + e (v_c − v⁻): what hits leaves
// at −e vrel, what rests on each other stays so, and e² of what compression took comes back.
#include <algorithm>
#include <cmath>

#include "sim/contact/impact_pass.h"

namespace tumble {
namespace {

/// What the second phase may give: its change of energy is a s + b s² for a share s of it, and no
/// more than compression took.
struct Budget {
  double taken = 0.0, a = 0.0, b = 0.0;  ///< [J]

  double share() const {
    const double room = std::max(0.0, taken);
    if (a + b <= room) return 1.0;
    const double root = std::sqrt(a * a + 4.0 * std::max(0.0, b) * room);
    const double s = a < 0.0 ? (root - a) / (2.0 * b) : root > 0.0 ? 2.0 * room / (a + root) : 0.0;
    return std::clamp(s, 0.0, 1.0);
  }
};

/// One blow.
class Crowd {
 public:
  Crowd(const Impact& impact, ImpactReport& report)
      : impact_(impact), report_(report), reached_(reachOfImpact(impact)) {}

  void strike();

 private:
  double vrel(std::size_t k) const;
  void findRestitution();
  void restore(std::span<const Compressed> taken);
  void give(std::span<const double> share, ImpactReport& to);

  const Impact& impact_;
  ImpactReport& report_;
  std::vector<int> reached_, island_;
  std::vector<double> e_;     ///< [1] per reached contact
  std::vector<double> back_;  ///< [N·s] that restitution gives each, if nothing is cut
};

double Crowd::vrel(std::size_t k) const {
  const Contact& c = impact_.contacts[reached_[k]];
  return approachVelocity(impact_.bodies[c.a], impact_.bodies[c.b], c.point);
}

/// Gives each contact a share of its restitution, by island, and sees to it that bonds hold.
void Crowd::give(std::span<const double> share, ImpactReport& to) {
  for (std::size_t k = 0; k < reached_.size(); ++k) {
    const double j = share[island_[k]] * back_[k];
    if (j <= 0.0) continue;
    const ImpulseEnergy energy =
        applyContactImpulse(impact_, reached_[k], j * impact_.contacts[reached_[k]].point.n);
    to.lostNormal += energy.lost;
    to.work += energy.work;
  }
  tighten(impact_, false, to);
}

/// Tries the whole restitution; gives less of it where that would add energy.
void Crowd::restore(std::span<const Compressed> taken) {
  std::vector<Budget> budgets(*std::max_element(island_.begin(), island_.end()) + 1);
  std::vector<double> before(reached_.size()), share(budgets.size(), 1.0);
  for (std::size_t k = 0; k < reached_.size(); ++k) {
    before[k] = vrel(k);
    budgets[island_[k]].taken += taken[k].lost;
  }
  budgets.front().taken += taken.back().lost;
  const std::vector<RigidBody> compressed(impact_.bodies.begin(), impact_.bodies.end());
  const std::vector<Vec3> impulse(impact_.impulse.begin(), impact_.impulse.end());
  const Bonds bonds = impact_.bound() ? *impact_.bonds : Bonds{};

  ImpactReport trial = report_;
  give(share, trial);
  for (std::size_t k = 0; k < reached_.size(); ++k) {
    budgets[island_[k]].a += back_[k] * before[k];
    budgets[island_[k]].b += 0.5 * back_[k] * (vrel(k) - before[k]);
  }
  for (std::size_t i = 0; i < budgets.size(); ++i) {
    const double s = share[i] = budgets[i].share();
    if (s < 1.0) trial.cut += (1.0 - s) * (budgets[i].a + (1.0 + s) * budgets[i].b);
  }
  if (std::all_of(share.begin(), share.end(), [](double s) { return s == 1.0; })) {
    report_ = trial;
    return;
  }
  report_.cut = trial.cut;
  std::copy(compressed.begin(), compressed.end(), impact_.bodies.begin());
  std::copy(impulse.begin(), impulse.end(), impact_.impulse.begin());
  if (impact_.bound()) *impact_.bonds = bonds;
  give(share, report_);
}

/// Per contact what it gives back of its compression: its own e where it hits; where it does not,
/// what holds during compression holds after it, by the mean e of what hits in its island.
void Crowd::findRestitution() {
  e_.assign(reached_.size(), 0.0);
  std::vector<double> speed(reached_.size(), 0.0), rebound(reached_.size(), 0.0);  // per island
  const auto hits = [&](std::size_t k) { return vrel(k) < -impact_.tolerance.rest; };
  for (std::size_t k = 0; k < reached_.size(); ++k) {
    if (!hits(k)) continue;
    e_[k] = impact_.restitution[reached_[k]];
    speed[island_[k]] -= vrel(k);
    rebound[island_[k]] -= e_[k] * vrel(k);
  }
  for (std::size_t k = 0; k < reached_.size(); ++k)
    if (!hits(k) && speed[island_[k]] > 0.0) e_[k] = rebound[island_[k]] / speed[island_[k]];
}

void Crowd::strike() {
  island_ = islandsOfContacts(impact_, reached_);
  findRestitution();
  const std::vector<Compressed> taken = compress(impact_, reached_, e_, island_, report_);
  for (std::size_t k = 0; k < reached_.size(); ++k) back_.push_back(e_[k] * taken[k].j);
  restore(taken);
}

}  // namespace

ImpactReport impactCrowd(const Impact& impact) {
  constexpr int kBlows = 100, kStops = 20;  // random heaps end after some; one took more than 20
  const int blows = impact.goesOn ? 1 : kBlows, stops = impact.goesOn ? 0 : kStops;
  ImpactReport report;
  for (int k = 0; k < blows && anyApproaching(impact); ++k) Crowd(impact, report).strike();
  for (int k = 0; k < stops && anyApproaching(impact); ++k)
    strikeOnce(impact, PassKind::Inelastic, report);
  return report;
}

}  // namespace tumble
