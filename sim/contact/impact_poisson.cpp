// Poisson's impact law: what compression took, restitution gives back in part.
#include <algorithm>
#include <cmath>

#include "sim/body/force.h"
#include "sim/contact/impact_pass.h"

namespace tumble {
namespace {

/// Halvings of the share of restitution that adds no energy.
constexpr int kHalvings = 40;
/// Stops after the restitution: one does, but for rounding.
constexpr int kPasses = 20;

/// Gives share · e · j of the compression back at every contact, and sees to it that none
/// approaches after.
ImpactReport restore(const Impact& impact, std::span<const Vec3> compression, double share) {
  ImpactReport report;
  std::vector<int> struck;
  std::vector<double> normal;
  for (std::size_t i = 0; i < compression.size(); ++i) {
    const Vec3& n = impact.contacts[i].point.n;
    const double j = share * impact.restitution[i] * n.dot(compression[i]);
    if (j <= 0.0) continue;
    const ImpulseEnergy energy = applyContactImpulse(impact, static_cast<int>(i), j * n);
    report.lostNormal += energy.lost;
    report.work += energy.work;
    struck.push_back(static_cast<int>(i));
    normal.push_back(j);
  }
  tighten(impact, false, report);
  const ImpulseEnergy friction = frictionImpulses(impact, struck, normal);
  report.lostFriction += friction.lost;
  report.work += friction.work;
  tighten(impact, true, report);
  for (int pass = 0; pass < kPasses && anyApproaching(impact); ++pass)
    strikeOnce(impact, PassKind::Inelastic, report);
  return report;
}

}  // namespace

ImpactReport impactPoisson(const Impact& impact) {
  ImpactReport report;
  if (!anyApproaching(impact)) return report;
  const double before = kineticEnergy(impact.bodies);
  strikeOnce(impact, PassKind::Inelastic, report);
  const std::vector<Vec3> compression(impact.impulse.begin(), impact.impulse.end());
  const std::vector<RigidBody> compressed(impact.bodies.begin(), impact.bodies.end());
  const Bonds bonds = impact.bound() ? *impact.bonds : Bonds{};
  const double work = report.work;

  // With unlike restitutions the law can add energy: then the largest share that does not.
  double share = 1.0, low = 0.0;
  for (int halving = 0;; ++halving) {
    const ImpactReport trial = restore(impact, compression, share);
    constexpr double kRounding = 1e-14;
    const bool gains =
        kineticEnergy(impact.bodies) - work - trial.work > before * (1.0 + kRounding);
    if (!gains && (share == 1.0 || halving >= kHalvings)) {
      add(trial, report);
      return report;
    }
    std::copy(compressed.begin(), compressed.end(), impact.bodies.begin());
    std::copy(compression.begin(), compression.end(), impact.impulse.begin());
    if (impact.bound()) *impact.bonds = bonds;
    if (gains && share == 1.0) {
      share = 0.5;
    } else {
      const double step = std::ldexp(0.5, -halving);
      if (!gains) low = share;
      share = halving + 1 >= kHalvings ? low : (gains ? share - step : share + step);
    }
  }
}

}  // namespace tumble
