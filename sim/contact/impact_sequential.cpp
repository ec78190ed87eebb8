// Newton's impact law at one contact after the other.
#include "sim/contact/impact_pass.h"
#include "sim/contact/impulse.h"

namespace tumble {

ImpactReport impactSequential(const Impact& impact) {
  constexpr int kHitsPerContact = 1000;
  ImpactReport report;
  tighten(impact, false, report);
  const int hits = kHitsPerContact * static_cast<int>(impact.contacts.size());
  for (int hit = 0; hit < hits; ++hit) {
    // The contact that approaches fastest is next.
    int fastest = -1;
    double worst = -impact.tolerance.rest;
    for (std::size_t i = 0; i < impact.contacts.size(); ++i) {
      const Contact& c = impact.contacts[i];
      const double vrel = approachVelocity(impact.bodies[c.a], impact.bodies[c.b], c.point);
      if (vrel < worst) {
        worst = vrel;
        fastest = static_cast<int>(i);
      }
    }
    if (fastest < 0) return report;

    // It gets its own impulse, as if it were alone with the bonds.
    if (impact.bound()) {
      strikeOne(impact, fastest, report);
      continue;
    }
    const Contact& c = impact.contacts[fastest];
    const double j = collisionImpulse(impact.bodies[c.a], impact.bodies[c.b], c.point,
                                      impact.restitution[fastest]);
    const ImpulseEnergy energy = applyContactImpulse(impact, fastest, j * c.point.n);
    report.lostNormal += energy.lost;
    report.work += energy.work;
    const ImpulseEnergy friction = frictionImpulses(impact, {&fastest, 1}, {&j, 1});
    report.lostFriction += friction.lost;
    report.work += friction.work;
  }

  // The hits did not come to an end: finish all of them together, without rebound.
  const std::vector<double> noRebound(impact.contacts.size(), 0.0);
  Impact rest = impact;
  rest.restitution = noRebound;
  const ImpactReport last = impactSimultaneous(rest);
  report.lostNormal += last.lostNormal;
  report.lostFriction += last.lostFriction;
  report.work += last.work;
  report.residual = last.residual;
  report.finishedInelastic = true;
  return report;
}

}  // namespace tumble
