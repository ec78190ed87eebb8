#include "sim/contact/jam.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/contact/modes.h"
#include "sim/contact/rows.h"
#include "sim/problem/cone.h"
#include "sim/problem/polish.h"

namespace tumble {
namespace {

/// What friction must leave of a push, see `pushLeft`.
constexpr double kPushLeft = 1e-11;
/// A step in which the slowest slip changes by this part of it is short; how steps get there.
constexpr double kShort = 1e-3, kShorter = 0.1;
/// [1] Slips and impulses below this part of others are rounding.
constexpr double kRounding = 1e-6;

/// Coulomb's law for impulses [N·s] over h [s] in which nothing moves, by the slip at its end. What
/// the contacts part with now counts as 0: they touch, and rest.
Problem stepOf(std::span<const RigidBody> bodies, std::span<const Contact> contacts,
               const Bonds& bonds, double h) {
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
  const std::size_t first = problem.rows.size();
  appendBonds(bonds, problem);
  for (std::size_t i = 0; i < bonds.rows.size(); ++i)
    problem.rows[first + i].bias =
        h * bondAcceleration(bonds.rows[i], bodies) - bondVelocity(bonds.rows[i], bodies);
  return problem;
}

/// What impulses do: they vanish with h, end a slip, or turn one.
enum class Effect { None, Turn, End };

Effect effectOf(std::span<const RigidBody> bodies, std::span<const Contact> contacts,
                std::span<const Vec3> impulses, const Bonds& bonds) {
  std::vector<RigidBody> after(bodies.begin(), bodies.end());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    applyImpulse(after[contacts[k].a], contacts[k].point.p, impulses[k]);
    applyImpulse(after[contacts[k].b], contacts[k].point.p, -impulses[k]);
  }
  addBondImpulses(bonds, after);
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

/// What the contacts get, whose cones come first, and the bonds.
std::vector<Vec3> impulsesOf(const Problem& problem, const Solution& solution, std::size_t contacts,
                             Bonds& bonds) {
  std::vector<Vec3> impulses;
  for (const Cone& cone : std::span(problem.cones).first(contacts)) {
    Vec3 sum = Vec3::Zero();
    for (int r = cone.row; r < cone.row + coneRows(cone.kind); ++r)
      sum += solution.lambda[r] * problem.rows[r].linear;
    impulses.push_back(sum);
  }
  readBonds(solution.lambda, problem.rows.size() - bonds.rows.size(), bonds);
  return impulses;
}

/// Impulses after which contacts that are pushed neither slip nor move along their normals, and the
/// others do not approach. Slips that a jam turns but does not end are left where friction takes
/// all of a push: the next step jams again, and so on until they end, at the same instant for h →
/// 0.
std::vector<Vec3> endOfSlips(std::span<const RigidBody> bodies, std::span<const Contact> contacts,
                             std::span<const Vec3> pushes, Bonds& bonds) {
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
  const std::size_t first = problem.rows.size();
  appendBonds(bonds, problem);
  for (std::size_t r = first; r < problem.rows.size(); ++r) problem.rows[r].bias = 0.0;
  Solution solution;
  solveByIslands(*findSolver("pivoting"), problem, {}, solution);
  readBonds(solution.lambda, first, bonds);
  std::vector<Vec3> impulses(contacts.size(), Vec3::Zero());
  for (std::size_t r = 0; r < owner.size(); ++r)
    impulses[owner[r]] += solution.lambda[r] * problem.rows[r].linear;
  return impulses;
}

/// The impulses that a jam ends in; none if there is no jam. Bodies carry their outer forces.
std::vector<Vec3> impulsesOfJam(std::span<const RigidBody> bodies,
                                std::span<const Contact> contacts, Bonds& bonds) {
  double pull = 0.0, least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const Contact& c : contacts) {
    pull = std::max(pull, -normalAcceleration(bodies[c.a], bodies[c.b], c.point));
    if (!c.sliding) continue;
    const double slip = slipVelocity(bodies[c.a], bodies[c.b], c.point).norm();
    least = std::min(least, slip);
    most = std::max(most, slip);
  }
  if (!(pull > 0.0)) return {};
  const Problem instant = stepOf(bodies, contacts, bonds, 0.0);
  for (double change = most; change > kShort * least; change *= kShorter) {
    Solution solution;
    const Problem step = stepOf(bodies, contacts, bonds, change / pull);
    solveByIslands(*findSolver("newton"), step, {}, solution);
    const SolveReport solved = polish(instant, {}, solution);
    if (solved.status != SolveStatus::Solved && !(solved.residual < kNoForces)) continue;
    const std::vector<Vec3> impulses = impulsesOf(instant, solution, contacts.size(), bonds);
    const Effect effect = effectOf(bodies, contacts, impulses, bonds);
    if (effect == Effect::End) return impulses;
    if (effect == Effect::Turn) return endOfSlips(bodies, contacts, impulses, bonds);
  }
  return {};
}

}  // namespace

// A contact that is its pair's only one tells by what friction leaves of its push.
bool jams(std::span<const RigidBody> bodies, std::span<const Contact> contacts) {
  return std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
    const auto ofPair = [&](const Contact& d) { return d.a == c.a && d.b == c.b; };
    if (!c.sliding || std::count_if(contacts.begin(), contacts.end(), ofPair) > 1) return false;
    const RigidBody &a = bodies[c.a], &b = bodies[c.b];
    return normalAcceleration(a, b, c.point) < 0.0 && pushLeft(a, b, c) <= kPushLeft;
  });
}

bool endJam(const Impact& impact, double kinetic, ImpulseEnergy& energy) {
  Bonds none, &bonds = impact.bonds ? *impact.bonds : none;
  const std::vector<Vec3> impulses = impulsesOfJam(impact.bodies, impact.contacts, bonds);
  if (impulses.empty()) return false;

  std::vector<RigidBody> before(impact.bodies.begin(), impact.bodies.end());
  double size = 0.0;
  for (std::size_t k = 0; k < impulses.size(); ++k) {
    const ImpulseEnergy one = applyContactImpulse(impact, static_cast<int>(k), impulses[k]);
    energy.lost += one.lost;
    energy.work += one.work;
    size += std::abs(one.lost);
  }
  if (!bonds.empty()) {
    const auto kineticOfAll = [&] {
      double sum = 0.0;
      for (const RigidBody& body : impact.bodies) sum += kineticEnergy(body);
      return sum;
    };
    const double start = kineticOfAll();
    addBondImpulses(bonds, impact.bodies);
    const double work = outerBonds(bonds, impact.bodies).power;
    const double lost = start - kineticOfAll() + work;
    energy.lost += lost;
    energy.work += work;
    size += std::abs(lost);
  }
  // A slip that ends cannot give energy.
  const double rounding = kRounding * std::max(size, kRounding * kinetic);
  if (energy.lost >= -rounding) return true;
  std::copy(before.begin(), before.end(), impact.bodies.begin());
  return false;
}

}  // namespace tumble
