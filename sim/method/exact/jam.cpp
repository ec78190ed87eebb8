// Painlevé's paradox: friction turns sliding bodies against their supports so that no forces,
// however large, keep them apart. The contacts jam: an impulse without collision ends a slip.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/contact/impact.h"
#include "sim/contact/modes.h"
#include "sim/contact/rows.h"
#include "sim/method/exact/exact.h"
#include "sim/problem/cone.h"
#include "sim/problem/polish.h"

namespace tumble {
namespace {

/// What friction must leave of a push, see `pushLeft`.
constexpr double kPushLeft = 1e-11;
/// Contact problems with a solution are solved to better than this.
constexpr double kUnsolved = 1e-8;
/// A step in which the slowest slip changes by this part of it is short; how steps get there.
constexpr double kShort = 1e-3, kShorter = 0.1;
/// [1] Slips and impulses below this part of others are rounding.
constexpr double kRounding = 1e-6;

/// Coulomb's law for impulses [N·s] over h [s] in which nothing moves, by the slip at its end. What
/// the contacts part with now counts as 0: they touch, and rest.
Problem stepOf(std::span<const RigidBody> bodies, std::span<const Contact> contacts, double h) {
  Problem problem;
  beginVelocityProblem(bodies, problem);
  for (const Contact& c : contacts) {
    const RigidBody &a = bodies[c.a], &b = bodies[c.b];
    const bool rubs = c.friction > 0.0;
    problem.cones.push_back({.kind = rubs ? ConeKind::Friction : ConeKind::Push,
                             .row = static_cast<int>(problem.rows.size()),
                             .mu = c.friction});
    const double pull = h * normalAcceleration(a, b, c.point) - approachVelocity(a, b, c.point);
    problem.rows.push_back(pointRow(bodies, c.a, c.b, c.point.p, c.point.n, pull));
    if (!rubs) continue;
    Vec3 t1, t2;
    tangents(c.point.n, slipVelocity(a, b, c.point), t1, t2);
    const Vec3 drift = h * slipAcceleration(a, b, c.point);
    for (const Vec3& t : {t1, t2})
      problem.rows.push_back(pointRow(bodies, c.a, c.b, c.point.p, t, drift.dot(t)));
  }
  return problem;
}

/// What impulses do: they vanish with h, end a slip, or turn one.
enum class Effect { None, Turn, End };

Effect effectOf(std::span<const RigidBody> bodies, std::span<const Contact> contacts,
                std::span<const Vec3> impulses) {
  std::vector<RigidBody> after(bodies.begin(), bodies.end());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    applyImpulse(after[contacts[k].a], contacts[k].point.p, impulses[k]);
    applyImpulse(after[contacts[k].b], contacts[k].point.p, -impulses[k]);
  }
  Effect effect = Effect::None;
  for (const Contact& c : contacts) {
    if (!c.sliding) continue;
    const Vec3 slip = slipVelocity(bodies[c.a], bodies[c.b], c.point);
    const Vec3 left = slipVelocity(after[c.a], after[c.b], c.point);
    if (left.norm() < kRounding * slip.norm()) return Effect::End;
    if ((left - slip).norm() > kRounding * slip.norm()) effect = Effect::Turn;
  }
  return effect;
}

std::vector<Vec3> impulsesOf(const Problem& problem, const Solution& solution) {
  std::vector<Vec3> impulses;
  for (const Cone& cone : problem.cones) {
    Vec3 sum = Vec3::Zero();
    for (int r = cone.row; r < cone.row + coneRows(cone.kind); ++r)
      sum += solution.lambda[r] * problem.rows[r].linear;
    impulses.push_back(sum);
  }
  return impulses;
}

/// Impulses after which contacts that are pushed neither slip nor move along their normals, and the
/// others do not approach. Slips that a jam turns but does not end are left where friction takes
/// all of a push: the next step jams again, and so on until they end, at the same instant for h →
/// 0.
std::vector<Vec3> endOfSlips(std::span<const RigidBody> bodies, std::span<const Contact> contacts,
                             std::span<const Vec3> pushes) {
  Problem problem;
  beginVelocityProblem(bodies, problem);
  double strongest = 0.0;
  for (const Vec3& push : pushes) strongest = std::max(strongest, push.norm());
  std::vector<std::size_t> owner;
  const auto add = [&](std::size_t k, const Vec3& d, ConeKind kind) {
    const Contact& c = contacts[k];
    problem.cones.push_back({.kind = kind, .row = static_cast<int>(problem.rows.size())});
    problem.rows.push_back(pointRow(bodies, c.a, c.b, c.point.p, d, 0.0));
    owner.push_back(k);
  };
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Vec3& n = contacts[k].point.n;
    const bool sticks = contacts[k].sliding && pushes[k].dot(n) > kRounding * strongest;
    add(k, n, sticks ? ConeKind::Equality : ConeKind::Push);
    if (!sticks) continue;
    Vec3 t1, t2;
    tangents(n, contacts[k].slipDirection, t1, t2);
    add(k, t1, ConeKind::Equality);
    add(k, t2, ConeKind::Equality);
  }
  Solution solution;
  solveByIslands(*findSolver("pivoting"), problem, {}, solution);
  std::vector<Vec3> impulses(contacts.size(), Vec3::Zero());
  for (std::size_t r = 0; r < owner.size(); ++r)
    impulses[owner[r]] += solution.lambda[r] * problem.rows[r].linear;
  return impulses;
}

/// The impulses that a jam ends in; none if there is no jam. Bodies carry their outer forces.
std::vector<Vec3> impulsesOfJam(std::span<const RigidBody> bodies,
                                std::span<const Contact> contacts) {
  double pull = 0.0, least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const Contact& c : contacts) {
    pull = std::max(pull, -normalAcceleration(bodies[c.a], bodies[c.b], c.point));
    if (!c.sliding) continue;
    const double slip = slipVelocity(bodies[c.a], bodies[c.b], c.point).norm();
    least = std::min(least, slip);
    most = std::max(most, slip);
  }
  if (!(pull > 0.0)) return {};
  const Problem instant = stepOf(bodies, contacts, 0.0);
  for (double change = most; change > kShort * least; change *= kShorter) {
    Solution solution;
    solveByIslands(*findSolver("newton"), stepOf(bodies, contacts, change / pull), {}, solution);
    const SolveReport solved = polish(instant, {}, solution);
    if (solved.status != SolveStatus::Solved && !(solved.residual < kUnsolved)) continue;
    const std::vector<Vec3> impulses = impulsesOf(instant, solution);
    const Effect effect = effectOf(bodies, contacts, impulses);
    if (effect == Effect::End) return impulses;
    if (effect == Effect::Turn) return endOfSlips(bodies, contacts, impulses);
  }
  return {};
}

}  // namespace

// A contact that is its pair's only one tells by what friction leaves of its push.
bool Exact::jams(const Contact& c, const std::vector<Contact>& resting) const {
  const auto ofPair = [&](const Contact& d) { return d.a == c.a && d.b == c.b; };
  if (!c.sliding || std::count_if(resting.begin(), resting.end(), ofPair) > 1) return false;
  RigidBody bodies[] = {state_.bodies[c.a], state_.bodies[c.b]};
  for (const int k : {0, 1}) {
    bodies[k].force = state_.exact.outer[k == 0 ? c.a : c.b];
    bodies[k].torque.setZero();
  }
  return normalAcceleration(bodies[0], bodies[1], c.point) < 0.0 &&
         pushLeft(bodies[0], bodies[1], c) <= kPushLeft;
}

// Where Coulomb's law has no forces, it has impulses: those of a step h whose friction obeys the
// slip that is left at its end. A step always has some (Stewart, Rigid-Body Dynamics with Friction
// and Impact, 2000, §5), and where there are no forces they do not vanish with h → 0; Génot and
// Brogliato 1999. Where they are more than one, the longest step decides.
bool Exact::endJam(double t, const Cluster& cluster, const std::vector<Contact>& resting,
                   double residual) {
  const bool asked = state_.exact.jammed || !(residual < kUnsolved) ||
                     std::any_of(resting.begin(), resting.end(),
                                 [&](const Contact& c) { return jams(c, resting); });
  state_.exact.jammed = false;
  if (!asked) return false;
  std::vector<RigidBody> bodies;
  std::vector<int> local(state_.bodies.size(), -1);
  for (const int i : cluster.bodies) {
    local[i] = static_cast<int>(bodies.size());
    bodies.push_back(state_.bodies[i]);
    bodies.back().force = state_.exact.outer[i];
    bodies.back().torque.setZero();
  }
  std::vector<Contact> contacts = resting;
  for (Contact& c : contacts) c.a = local[c.a], c.b = local[c.b];
  const std::vector<Vec3> impulse = impulsesOfJam(bodies, contacts);
  if (impulse.empty()) return false;

  std::vector<Vec3> given(contacts.size(), Vec3::Zero());
  const std::vector<double> restitution(contacts.size(), 0.0);
  const Impact impact{bodies, contacts, restitution, given, tolerance_};
  ImpulseEnergy sum;
  double size = 0.0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const ImpulseEnergy energy = applyContactImpulse(impact, static_cast<int>(k), impulse[k]);
    sum.lost += energy.lost;
    sum.work += energy.work;
    size += std::abs(energy.lost);
  }
  const double rounding = kRounding * std::max(size, kRounding * state_.kineticMax);
  if (sum.lost < -rounding) return false;  // a slip that ends cannot give energy
  report_.certificate.energy_lost_friction += sum.lost;
  report_.certificate.work_of_forces += sum.work;
  for (const int i : cluster.bodies)
    if (!model_.fixed(i)) state_.bodies[i] = bodies[local[i]];
  recordImpacts(t, {.bodies = cluster.bodies, .contacts = resting},
                std::vector<double>(resting.size(), 0.0), given);
  report_.note("a sliding contact jammed (Painleve): an impulse without collision ended its slip");
  return true;
}

}  // namespace tumble
