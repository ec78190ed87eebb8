// Newton's impact law at all contacts at once, as a linear complementarity problem.
#include "sim/contact/impact.h"
#include "sim/contact/rows.h"

namespace tumble {
namespace {

constexpr int kPasses = 60;

/// One pass: normal impulses from the LCP over the reached contacts, then friction.
/// Contacts that already separate stay out, so that no pass can add energy; the last pass takes all
/// of them with e = 0, which is the projection onto what does not approach.
void strike(const Impact& impact, bool inelastic, ImpactReport& report) {
  Problem problem;
  std::vector<int> struck;
  beginVelocityProblem(impact.bodies, problem);
  for (int i : reachOfImpact(impact)) {
    const Contact& c = impact.contacts[i];
    const double vrel = approachVelocity(impact.bodies[c.a], impact.bodies[c.b], c.point);
    const ContactClass kind = classify(vrel, impact.tolerance.rest);
    if (kind == ContactClass::Separating && !inelastic) continue;
    const bool bounces = kind == ContactClass::Colliding && !inelastic;
    const double bias = bounces ? impact.restitution[i] * vrel : 0.0;
    problem.cones.push_back({.kind = ConeKind::Push, .row = static_cast<int>(problem.rows.size())});
    problem.rows.push_back(pointRow(impact.bodies, c.a, c.b, c.point.p, c.point.n, bias));
    struck.push_back(i);
  }

  Solution solution;
  const SolveReport solved = solveByIslands(*findSolver("pivoting"), problem, {}, solution);
  report.residual = std::max(report.residual, solved.residual);
  for (std::size_t k = 0; k < struck.size(); ++k) {
    const Vec3 J = solution.lambda[k] * impact.contacts[struck[k]].point.n;
    const ImpulseEnergy energy = applyContactImpulse(impact, struck[k], J);
    report.lostNormal += energy.lost;
    report.work += energy.work;
  }
  const ImpulseEnergy friction = frictionImpulses(impact, struck, solution.lambda);
  report.lostFriction += friction.lost;
  report.work += friction.work;
}

bool approaching(const Impact& impact) {
  for (const Contact& c : impact.contacts)
    if (approachVelocity(impact.bodies[c.a], impact.bodies[c.b], c.point) < -impact.tolerance.rest)
      return true;
  return false;
}

}  // namespace

ImpactReport impactSimultaneous(const Impact& impact) {
  ImpactReport report;
  for (int pass = 0; pass < kPasses && approaching(impact); ++pass) strike(impact, false, report);
  if (approaching(impact)) {
    strike(impact, true, report);
    report.finishedInelastic = true;
  }
  return report;
}

}  // namespace tumble
