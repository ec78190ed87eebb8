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

std::pair<int, int> Stepping::ends(Link link) const {
  if (isPair(link)) return state_.near[link];
  const Row& row = bonds_.rows[link - state_.near.size()];
  return {row.b, row.a};
}

void Stepping::solveIslands(double h) {
  const std::size_t n = state_.bodies.size();
  for (std::size_t i = 0; i < n; ++i) {
    const RigidBody& body = state_.bodies[i];
    star_[i] = before_[i];
    if (!body.fixed())
      star_[i] << body.v + h * body.invM * body.force, body.Iinv * (body.L + h * body.torque);
  }
  after_ = star_;
  bonds_.clear();
  if (!model_.joints.empty()) stepBonds(state_.bodies, model_.joints, star_, h, bonds_);
  touched_.assign(n, 0);
  later_.assign(n, 0.0);
  memory_.islands.resize(n);
  allKept_ = true;
  groupLinks();
  for (std::size_t i = 0; i + 1 < begin_.size(); ++i)
    solveIsland(std::span(order_).subspan(begin_[i], begin_[i + 1] - begin_[i]), h);
  if (!bonds_.empty()) bookJoints(h);
}

/// Deals what joins bodies out to islands, in the order of their first links.
void Stepping::groupLinks() {
  const int count = static_cast<int>(state_.near.size() + bonds_.rows.size());
  const int world = static_cast<int>(state_.bodies.size());
  const auto joins = [&](Link link) {
    return !isPair(link) || !memory_.pairs[link].touches.empty();
  };
  const auto fixed = [&](int body) { return body == world || model_.fixed(body); };
  root_.resize(world);
  std::iota(root_.begin(), root_.end(), 0);
  for (Link link = 0; link < count; ++link) {
    const auto [b, a] = ends(link);
    if (!joins(link) || fixed(a) || fixed(b)) continue;
    const int p = islandRoot(root_, a), q = islandRoot(root_, b);
    root_[std::max(p, q)] = std::min(p, q);
  }
  // Count, then place: `local_` numbers the islands for a moment.
  local_.assign(world + 1, -1);
  begin_.assign(1, 0);
  const auto islandOf = [&](Link link) -> int& {
    const auto [b, a] = ends(link);
    return local_[islandRoot(root_, fixed(a) ? b : a)];
  };
  for (Link link = 0; link < count; ++link) {
    if (!joins(link)) continue;
    int& island = islandOf(link);
    if (island < 0) {
      island = static_cast<int>(begin_.size()) - 1;
      begin_.push_back(0);
    }
    ++begin_[island + 1];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  order_.resize(begin_.back());
  movers_.assign(begin_.begin(), begin_.end());
  for (Link link = 0; link < count; ++link)
    if (joins(link)) order_[movers_[islandOf(link)]++] = link;
  std::fill(local_.begin(), local_.end(), -1);
}

/// The bodies of an island that move, in the order of its links.
void Stepping::collectBodies(std::span<const Link> links) {
  const int world = static_cast<int>(state_.bodies.size());
  movers_.clear();
  for (const Link link : links) {
    const auto [b, a] = ends(link);
    for (const int i : {a, b}) {
      if (i == world || model_.fixed(i) || local_[i] >= 0) continue;
      local_[i] = 0;
      movers_.push_back(i);
    }
  }
  for (const int i : movers_) local_[i] = -1;
}

/// Whether an island asks what it asked when it was solved: the same points, and velocities that
/// differ by less than the tolerance on the residual.
bool Stepping::keeps(const IslandMemory& memory, std::span<const Link> links) const {
  if (memory.bodies != movers_ || memory.looks.size() != links.size()) return false;
  for (std::size_t k = 0; k < links.size(); ++k)
    if (!isPair(links[k]) || memory.looks[k] != memory_.pairs[links[k]].look) return false;
  const double allowed = model_.def.stepping.tolerance * memory.scale;
  for (std::size_t i = 0; i < movers_.size(); ++i)
    if (!((star_[movers_[i]] - memory.vStar[i]).lpNorm<Eigen::Infinity>() <= allowed)) return false;
  for (const Link link : links)
    for (const Touch& touch : memory_.pairs[link].touches)
      if (touch.arrivalSpeed > 0.0 || touch.rebounds) return false;
  return true;
}

/// Bodies that joints alone hold take half of what forces give before they move, half after: their
/// error is of second order. Springs must not be met later.
void Stepping::swing(std::span<const Link> links, double h) {
  for (const Link link : links)
    if (isPair(link) || bonds_.kinds[link - state_.near.size()] != ConeKind::Equality) return;
  for (const int i : movers_) {
    const RigidBody& body = state_.bodies[i];
    if (sprung(body)) continue;
    later_[i] = 0.5 * h;
    star_[i] << body.v + later_[i] * body.invM * body.force,
        body.Iinv * (body.L + later_[i] * body.torque);
  }
}

void Stepping::solveIsland(std::span<const Link> links, double h) {
  constexpr int kMost = 4000;  // sweeps: more bring little; what is left is in the certificate
  Certificate& certificate = report_.certificate;
  collectBodies(links);
  if (movers_.empty()) return;
  swing(links, h);
  IslandMemory& memory = memory_.islands[movers_.front()];
  if (!keeps(memory, links)) {
    allKept_ = false;
    build(links, h);
    const SolveReport solved = solver_.solve(
        problem_, {.tolerance = model_.def.stepping.tolerance, .maxIterations = kMost}, solution_);
    if (solved.status != SolveStatus::Solved)
      report_.note("some steps were left above the tolerance; max_complementarity has the worst");
    memory.residual = solved.residual;
    share(links, memory, h);
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
    local_[body] = static_cast<int>(problem_.invM.size());
    const bool world = body == static_cast<int>(state_.bodies.size());
    problem_.invM.push_back(world ? 0.0 : state_.bodies[body].invM);
    problem_.Iinv.push_back(world ? Mat3(Mat3::Zero()) : state_.bodies[body].Iinv);
    problem_.vStar.push_back(star_[body]);
    solution_.v.push_back(before_[body]);
    bodies_.push_back(body);
  }
  return local_[body];
}

void Stepping::build(std::span<const Link> links, double h) {
  problem_.invM.clear();
  problem_.Iinv.clear();
  problem_.vStar.clear();
  problem_.rows.clear();
  problem_.cones.clear();
  solution_.lambda.clear();
  solution_.v.clear();
  bodies_.clear();
  for (const Link link : links) {
    if (isPair(link)) {
      std::vector<Touch>& touches = memory_.pairs[link].touches;
      const bool allClosed = std::all_of(touches.begin(), touches.end(),
                                         [&](const Touch& touch) { return closed(touch); });
      for (Touch& touch : touches) addTouch(touch, allClosed, h);
      continue;
    }
    problem_.cones.push_back({.kind = bonds_.kinds[link - state_.near.size()],
                              .row = static_cast<int>(problem_.rows.size())});
    addRow(bondOf(link));
  }
}

void Stepping::addRow(Row row) {
  row.a = localOf(row.a);
  row.b = localOf(row.b);
  problem_.rows.push_back(row);
}

/// Adds a point of a pair, of which all points touch or not.
void Stepping::addTouch(Touch& touch, bool allClosed, double h) {
  const Contact& contact = touch.contact;
  const ContactPoint& c = contact.point;
  Row normal = pointRow(state_.bodies, contact.a, contact.b, c.p, c.n, 0.0);

  // A gap may be closed by the end of the step and no further. The step after, on the surface, the
  // hit rebounds with the speed at which it came: so a bounce starts where it should and gains no
  // height.
  const double vrel = rowSpeed(normal, before_[contact.a], before_[contact.b]);
  touch.approach = std::max(touch.arrivalSpeed, -vrel);
  const bool arrived = closed(touch);
  const bool hits = c.separation + h * rowSpeed(normal, star_[contact.a], star_[contact.b]) < 0.0;
  const bool rebounds = arrived && hits && touch.approach > 0.0 && contact.restitution > 0.0;
  // Gaps of one face go together: all are as found, or, where all touch, none is left of them.
  const double gap = allClosed ? 0.0 : std::max(c.separation, -tolerance_.root);
  normal.bias = rebounds ? -contact.restitution * touch.approach : gap / h;
  touch.rebounds = rebounds && normal.bias < landingSpeed();

  Cone cone{.kind = ConeKind::Push, .row = static_cast<int>(problem_.rows.size())};
  addRow(normal);
  if (contact.friction > 0.0) {
    cone.kind = ConeKind::Friction;
    cone.mu = contact.friction;
    Vec3 t1, t2;
    tangents(c.n, slipVelocity(state_.bodies[contact.a], state_.bodies[contact.b], c), t1, t2);
    for (const Vec3& t : {t1, t2})
      addRow(pointRow(state_.bodies, contact.a, contact.b, c.p, t, 0.0));
  }
  problem_.cones.push_back(cone);
}

/// Gives the solution to the contacts and bodies of an island, and remembers it.
void Stepping::share(std::span<const Link> links, IslandMemory& memory, double h) {
  memory.bodies = movers_;
  memory.looks.clear();
  memory.books = {};
  memory.scale = velocityScale(problem_);
  std::size_t cone = 0;
  for (const Link link : links) {
    if (!isPair(link)) {
      memory.looks.push_back(0);
      bonds_.lambda[link - state_.near.size()] = solution_.lambda[problem_.cones[cone++].row];
      continue;
    }
    memory.looks.push_back(memory_.pairs[link].look);
    for (Touch& touch : memory_.pairs[link].touches)
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
