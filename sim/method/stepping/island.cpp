// The contact problem, island by island. Forces are a function of the configuration: an island
// whose contacts, loads and velocities are those it was solved with keeps its answer, any other one
// is solved from λ = 0.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/contact/rows.h"
#include "sim/method/stepping/stepping.h"
#include "sim/problem/cone.h"

namespace tumble {
namespace {

/// Root of a body in the forest of islands; halves the path on its way.
int find(std::vector<int>& parent, int i) {
  while (parent[i] != i) {
    parent[i] = parent[parent[i]];
    i = parent[i];
  }
  return i;
}

double rowSpeed(const Row& row, const Vec6& a, const Vec6& b) {
  return row.linear.dot(a.head<3>() - b.head<3>()) + row.angularA.dot(a.tail<3>()) +
         row.angularB.dot(b.tail<3>());
}

}  // namespace

void Stepping::solveIslands(double h) {
  touched_.assign(state_.bodies.size(), 0);
  local_.assign(state_.bodies.size(), -1);
  memory_.islands.resize(state_.bodies.size());
  allKept_ = true;
  groupPairs();
  for (std::size_t i = 0; i + 1 < begin_.size(); ++i)
    solveIsland(std::span(order_).subspan(begin_[i], begin_[i + 1] - begin_[i]), h);
}

/// Deals the pairs that touch out to islands, in the order of their first pairs.
void Stepping::groupPairs() {
  root_.resize(state_.bodies.size());
  std::iota(root_.begin(), root_.end(), 0);
  for (std::size_t k = 0; k < state_.near.size(); ++k) {
    const auto [b, a] = state_.near[k];
    if (memory_.pairs[k].touches.empty() || model_.fixed(a) || model_.fixed(b)) continue;
    const int p = find(root_, a), q = find(root_, b);
    root_[std::max(p, q)] = std::min(p, q);
  }
  // Count, then place: `local_` numbers the islands for a moment.
  begin_.assign(1, 0);
  const auto islandOf = [&](std::size_t k) -> int& {
    const auto [b, a] = state_.near[k];
    return local_[find(root_, model_.fixed(a) ? b : a)];
  };
  for (std::size_t k = 0; k < state_.near.size(); ++k) {
    if (memory_.pairs[k].touches.empty()) continue;
    int& island = islandOf(k);
    if (island < 0) {
      island = static_cast<int>(begin_.size()) - 1;
      begin_.push_back(0);
    }
    ++begin_[island + 1];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  order_.resize(begin_.back());
  movers_.assign(begin_.begin(), begin_.end());
  for (std::size_t k = 0; k < state_.near.size(); ++k)
    if (!memory_.pairs[k].touches.empty()) order_[movers_[islandOf(k)]++] = static_cast<int>(k);
  std::fill(local_.begin(), local_.end(), -1);
}

void Stepping::collectBodies(std::span<const int> pairs, double h) {
  bodies_.clear();
  movers_.clear();
  for (const int k : pairs) {
    const auto [b, a] = state_.near[k];
    for (const int i : {a, b}) {
      if (local_[i] >= 0) continue;
      local_[i] = static_cast<int>(bodies_.size());
      bodies_.push_back(i);
      if (model_.fixed(i)) continue;
      movers_.push_back(i);
      const RigidBody& body = state_.bodies[i];
      star_[i] << body.v + h * body.invM * body.force, body.Iinv * (body.L + h * body.torque);
    }
  }
  for (const int i : bodies_) local_[i] = -1;
}

/// Whether an island asks what it asked when it was solved: the same points, and velocities that
/// differ by less than the tolerance on the residual.
bool Stepping::keeps(const IslandMemory& memory, std::span<const int> pairs) const {
  if (memory.bodies != movers_ || memory.looks.size() != pairs.size()) return false;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (memory.looks[k] != memory_.pairs[pairs[k]].look) return false;
  const double allowed = model_.def.stepping.tolerance * memory.scale;
  for (std::size_t i = 0; i < movers_.size(); ++i)
    if (!((star_[movers_[i]] - memory.vStar[i]).lpNorm<Eigen::Infinity>() <= allowed)) return false;
  for (const int k : pairs)
    for (const Touch& touch : memory_.pairs[k].touches)
      if (touch.arrivalSpeed > 0.0 || touch.rebounds) return false;
  return true;
}

void Stepping::solveIsland(std::span<const int> pairs, double h) {
  Certificate& certificate = report_.certificate;
  collectBodies(pairs, h);
  if (movers_.empty()) return;
  IslandMemory& memory = memory_.islands[movers_.front()];
  if (!keeps(memory, pairs)) {
    allKept_ = false;
    build(pairs, h);
    const SolveReport solved = solver_.solve(
        problem_, {.tolerance = model_.def.stepping.tolerance, .maxIterations = 2000}, solution_);
    if (solved.status != SolveStatus::Solved)
      report_.note("some steps were left above the tolerance; max_complementarity has the worst");
    memory.residual = solved.residual;
    share(pairs, memory, h);
  }
  certificate.max_complementarity = std::max(certificate.max_complementarity, memory.residual);
  certificate.energy_lost_impact += memory.books.lostImpact;
  certificate.energy_lost_friction += memory.books.lostFriction;
  certificate.work_of_forces += memory.books.work;
  state_.externalImpulse += memory.books.external;
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    after_[movers_[i]] = memory.v[i];
    touched_[movers_[i]] = memory.v[i] != memory.vStar[i];
  }
}

/// Number of a body in the problem of its island.
int Stepping::localOf(int body) {
  if (local_[body] < 0) {
    const RigidBody& b = state_.bodies[body];
    local_[body] = static_cast<int>(problem_.invM.size());
    problem_.invM.push_back(b.invM);
    problem_.Iinv.push_back(b.Iinv);
    problem_.vStar.push_back(b.fixed() ? before_[body] : star_[body]);
    solution_.v.push_back(before_[body]);
  }
  return local_[body];
}

void Stepping::build(std::span<const int> pairs, double h) {
  problem_.invM.clear();
  problem_.Iinv.clear();
  problem_.vStar.clear();
  problem_.rows.clear();
  problem_.cones.clear();
  solution_.lambda.clear();
  solution_.v.clear();
  for (const int k : pairs)
    for (Touch& touch : memory_.pairs[k].touches) addTouch(touch, h);
}

void Stepping::addTouch(Touch& touch, double h) {
  const Contact& contact = touch.contact;
  const ContactPoint& c = contact.point;
  Row normal = pointRow(state_.bodies, contact.a, contact.b, c.p, c.n, 0.0);

  // A gap may be closed by the end of the step and no further. The step after, on the surface, the
  // hit rebounds with the speed at which it came: so a bounce starts where it should and gains no
  // height.
  const Vec6& starA = model_.fixed(contact.a) ? before_[contact.a] : star_[contact.a];
  const Vec6& starB = model_.fixed(contact.b) ? before_[contact.b] : star_[contact.b];
  const double vrel = rowSpeed(normal, before_[contact.a], before_[contact.b]);
  touch.approach = std::max(touch.arrivalSpeed, -vrel);
  const bool arrived = c.separation <= tolerance_.touch;
  const bool hits = c.separation + h * rowSpeed(normal, starA, starB) < 0.0;
  const bool rebounds = arrived && hits && touch.approach > 0.0 && contact.restitution > 0.0;
  normal.bias = rebounds ? -contact.restitution * touch.approach : std::max(0.0, c.separation) / h;
  touch.rebounds = rebounds && normal.bias < landingSpeed();

  const int a = localOf(contact.a), b = localOf(contact.b);
  const auto add = [&](Row row) {
    row.a = a;
    row.b = b;
    problem_.rows.push_back(row);
  };
  Cone cone{.kind = ConeKind::Push, .row = static_cast<int>(problem_.rows.size())};
  add(normal);
  if (contact.friction > 0.0) {
    cone.kind = ConeKind::Friction;
    cone.mu = contact.friction;
    Vec3 t1, t2;
    tangents(c.n, slipVelocity(state_.bodies[contact.a], state_.bodies[contact.b], c), t1, t2);
    for (const Vec3& t : {t1, t2}) add(pointRow(state_.bodies, contact.a, contact.b, c.p, t, 0.0));
  }
  problem_.cones.push_back(cone);
}

/// Gives the solution to the contacts and bodies of an island, and remembers it.
void Stepping::share(std::span<const int> pairs, IslandMemory& memory, double h) {
  memory.bodies = movers_;
  memory.looks.clear();
  memory.books = {};
  memory.scale = velocityScale(problem_);
  std::size_t cone = 0;
  for (const int k : pairs) {
    memory.looks.push_back(memory_.pairs[k].look);
    for (Touch& touch : memory_.pairs[k].touches)
      shareTouch(touch, problem_.cones[cone++], memory.books, h);
  }
  memory.vStar.clear();
  memory.v.clear();
  for (const int i : movers_) {
    memory.vStar.push_back(star_[i]);
    memory.v.push_back(solution_.v[local_[i]]);
  }
  for (const int i : bodies_) local_[i] = -1;
}

void Stepping::shareTouch(Touch& touch, const Cone& cone, IslandBooks& books, double h) {
  Contact& contact = touch.contact;
  touch.impulse.setZero();
  for (int r = cone.row; r < cone.row + coneRows(cone.kind); ++r) {
    const Row& row = problem_.rows[r];
    const double lambda = solution_.lambda[r];
    touch.impulse += lambda * row.linear;
    // Work over the step is λ times the mean of the velocities before and after.
    const Vec6 a = 0.5 * (before_[contact.a] + solution_.v[row.a]);
    const Vec6 b = 0.5 * (before_[contact.b] + solution_.v[row.b]);
    const double ofA = row.linear.dot(a.head<3>()) + row.angularA.dot(a.tail<3>());
    const double ofB = -row.linear.dot(b.head<3>()) + row.angularB.dot(b.tail<3>());
    (r == cone.row ? books.lostImpact : books.lostFriction) -= lambda * (ofA + ofB);
    if (model_.fixed(contact.a)) books.work -= lambda * ofA;
    if (model_.fixed(contact.b)) books.work -= lambda * ofB;
  }
  if (model_.fixed(contact.b)) books.external += touch.impulse;
  if (model_.fixed(contact.a)) books.external -= touch.impulse;
  contact.force = touch.impulse / h;

  const double j = touch.impulse.dot(contact.point.n);
  const Vec3 tangential = touch.impulse - j * contact.point.n;
  const Row& first = problem_.rows[cone.row];
  const Vec6 &va = solution_.v[first.a], &vb = solution_.v[first.b];
  const Vec3 rate = va.head<3>() +
                    va.tail<3>().cross(contact.point.p - state_.bodies[contact.a].x) -
                    vb.head<3>() - vb.tail<3>().cross(contact.point.p - state_.bodies[contact.b].x);
  const Vec3 slip = rate - rate.dot(contact.point.n) * contact.point.n;
  contact.sliding = contact.friction > 0.0 &&
                    tangential.norm() >= contact.friction * j * (1.0 - 1e-9) &&
                    slip.norm() > tolerance_.stick;
  contact.lasting = !arrives(touch) && !touch.rebounds;
}

}  // namespace tumble
