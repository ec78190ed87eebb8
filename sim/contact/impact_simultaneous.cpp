// Newton's impact law at all contacts at once, as a linear complementarity problem.
#include <algorithm>

#include "sim/contact/impact.h"
#include "sim/contact/rows.h"

namespace tumble {
namespace {

constexpr int kPasses = 20;
constexpr int kSweeps = 500;

/// The contacts that take part in one pass, and their rows.
struct Strike {
  Problem problem;
  std::vector<int> contacts;
};

void addContact(const Impact& impact, int i, double bias, bool withFriction, Strike& strike) {
  const Contact& c = impact.contacts[i];
  const RigidBody &a = impact.bodies[c.a], &b = impact.bodies[c.b];
  Problem& problem = strike.problem;
  strike.contacts.push_back(i);
  const bool cone = withFriction && c.friction > 0.0;
  problem.cones.push_back({.kind = cone ? ConeKind::Friction : ConeKind::Push,
                           .row = static_cast<int>(problem.rows.size()),
                           .mu = cone ? c.friction : 0.0});
  problem.rows.push_back(pointRow(impact.bodies, c.a, c.b, c.point.p, c.point.n, bias));
  if (!cone) return;
  Vec3 t1, t2;
  tangents(c.point.n, slipVelocity(a, b, c.point), t1, t2);
  for (const Vec3& t : {t1, t2})
    problem.rows.push_back(pointRow(impact.bodies, c.a, c.b, c.point.p, t, 0.0));
}

/// Gives the impulses of a solved pass, first along the normals, then across them.
std::vector<double> give(const Impact& impact, const Strike& strike, const Solution& solution,
                         ImpactReport& report) {
  std::vector<double> j;
  for (std::size_t k = 0; k < strike.contacts.size(); ++k) {
    const Cone& cone = strike.problem.cones[k];
    j.push_back(solution.lambda[cone.row]);
    const ImpulseEnergy normal = applyContactImpulse(
        impact, strike.contacts[k], j.back() * strike.problem.rows[cone.row].linear);
    report.lostNormal += normal.lost;
    report.work += normal.work;
    if (cone.kind != ConeKind::Friction) continue;
    const Vec3 across = solution.lambda[cone.row + 1] * strike.problem.rows[cone.row + 1].linear +
                        solution.lambda[cone.row + 2] * strike.problem.rows[cone.row + 2].linear;
    const ImpulseEnergy friction = applyContactImpulse(impact, strike.contacts[k], across);
    report.lostFriction += friction.lost;
    report.work += friction.work;
  }
  return j;
}

/// One pass over the reached contacts. Contacts that already separate stay out, so that no pass can
/// add energy. Where nothing rebounds, normal and friction impulses are one problem, which takes
/// energy whatever the friction; else the normal impulses come first and friction, bounded by them,
/// after. The last pass takes all contacts without rebound.
void strike(const Impact& impact, bool inelastic, ImpactReport& report) {
  Strike pass;
  beginVelocityProblem(impact.bodies, pass.problem);
  const std::vector<int> reached = reachOfImpact(impact);
  const auto vrel = [&](int i) {
    const Contact& c = impact.contacts[i];
    return approachVelocity(impact.bodies[c.a], impact.bodies[c.b], c.point);
  };
  const bool together = inelastic || std::none_of(reached.begin(), reached.end(), [&](int i) {
                          return impact.restitution[i] > 0.0 && vrel(i) < -impact.tolerance.rest;
                        });
  for (int i : reached) {
    const ContactClass kind = classify(vrel(i), impact.tolerance.rest);
    if (kind == ContactClass::Separating && !inelastic) continue;
    const bool bounces = kind == ContactClass::Colliding && !inelastic;
    addContact(impact, i, bounces ? impact.restitution[i] * vrel(i) : 0.0, together, pass);
  }

  const bool friction = pass.problem.rows.size() > pass.problem.cones.size();
  Solution solution;
  const SolveReport solved = solveByIslands(*findSolver(friction ? "pgs" : "pivoting"),
                                            pass.problem, {.maxIterations = kSweeps}, solution);
  report.residual = std::max(report.residual, solved.residual);
  const std::vector<double> j = give(impact, pass, solution, report);
  if (together) return;
  const ImpulseEnergy energy = frictionImpulses(impact, pass.contacts, j);
  report.lostFriction += energy.lost;
  report.work += energy.work;
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
