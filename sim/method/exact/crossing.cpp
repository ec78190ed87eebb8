#include "sim/method/exact/crossing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/collide/approach.h"
#include "sim/collide/collide.h"
#include "sim/contact/rows.h"
#include "sim/math/rotation.h"
#include "sim/method/method.h"
#include "sim/problem/cone.h"

namespace tumble {
namespace {

/// Steps that are cut short by a touch, before the last is taken as it is.
constexpr int kCuts = 20;
/// Passes in which contacts are looked at as they are at the end.
constexpr int kBends = 3;
/// Overlap [m] per size of the world that a shorter step is taken for, and by what part.
constexpr double kDeep = 1e-7, kShorter = 0.5;
/// A step that is shorter must leave less than this part of the overlap, or it is no use.
constexpr double kEases = 0.8;

}  // namespace

RigidBody across(const Model& model, const State& state, const RigidBody& start, int i,
                 const Vec3& P, const Vec3& L, bool kicked, double h) {
  RigidBody body = start;
  if (kicked) {
    body.P = P;
    body.L = L;
    updateDerived(body);
    Flight(body, Vec3::Zero(), 0.0).at(h, body);
    return body;
  }
  for (const Pivot& pivot : model.pivots) {
    if (pivot.body != i) continue;
    HeavyTop top(start, pivot, model.def.gravity, 0.0);
    if (top.reach(h)) top.at(h, body);
    return body;
  }
  Flight(start, start.invM * state.exact.outer[static_cast<std::size_t>(i)], 0.0).at(h, body);
  return body;
}

Crossing::Crossing(const Model& model, const State& state)
    : model_(model), state_(state), start_(state.bodies), end_(state.bodies) {}

/// [m/s²] of a body without contacts.
double Crossing::pull(int i) const {
  return start_[i].invM * state_.exact.outer[i].norm();
}

void Crossing::findPairs(double most) {
  double fall = model_.def.gravity.norm();
  for (int i = 0; i < model_.count(); ++i) fall = std::max(fall, pull(i));
  const double touch = ContactTolerance::forSize(model_.size).touch;
  std::vector<Aabb> boxes;
  sweptBoxes(model_, start_, most, fall, touch, boxes);
  pairs_.clear();
  for (std::size_t p = 0; p < boxes.size(); ++p)
    for (std::size_t q = p + 1; q < boxes.size(); ++q) {
      const int i = model_.solid[p], j = model_.solid[q];
      if (!model_.mayTouch(i, j) || !boxes[p].overlaps(boxes[q])) continue;
      const auto [b, a] = std::minmax(i, j);
      if (!canCollide(model_.shapes[a], model_.shapes[b])) continue;
      pairs_.push_back({.b = b, .a = a});
    }
}

// What is nearer than a body falls in half the step, and no faster than it would get, has bounced
// its last.
void Crossing::findPoints(double most) {
  const double touch = ContactTolerance::forSize(model_.size).touch;
  const double rest = ContactTolerance::forSize(model_.size).rest;
  points_.clear();
  std::vector<Contact> found;
  for (Pair& pair : pairs_) {
    const double fall = pull(pair.a) + pull(pair.b);
    const double low = std::max(touch, fall * most * most / 8.0);
    const RigidBody &a = start_[pair.a], &b = start_[pair.b];
    const auto turning = [&](const RigidBody& body, int i) {
      const double radius = boundingRadius(model_.shapes[i]);
      return std::isfinite(radius) ? body.omega.norm() * radius : 0.0;
    };
    const double speed = (a.v - b.v).norm() + turning(a, pair.a) + turning(b, pair.b);
    found.clear();
    findContacts(model_, start_, {pair.b, pair.a}, low + most * (speed + fall * most), found);
    const auto hits = [&](const Contact& c) {
      return c.point.separation <= touch &&
             -c.restitution * approachVelocity(a, b, c.point) > std::max(fall * most, rest);
    };
    touches = touches || std::any_of(found.begin(), found.end(), hits);
    pair.touches = std::any_of(found.begin(), found.end(), [&](const Contact& c) {
      const double gap = c.point.separation;
      return gap <= touch || (gap <= low && approachVelocity(a, b, c.point) >= -fall * most);
    });
    if (!pair.touches) continue;
    for (Contact& c : found) {
      c.anchor = anchorOf(a, b, c.point);
      points_.push_back(c);
    }
  }
  active_.clear();
  for (const Contact& c : points_)
    active_.push_back(c.point.separation <=
                      std::max(touch, (pull(c.a) + pull(c.b)) * most * most / 8.0));
}

void Crossing::solve() {
  Problem problem;
  beginVelocityProblem(start_, problem);
  for (std::size_t i = 0; i < start_.size(); ++i)
    problem.vStar[i].head<3>() += h * start_[i].invM * state_.exact.outer[i];
  std::vector<std::size_t> owner;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (!active_[k]) continue;
    // The rows of the end, where those of the start lead into an overlap.
    const std::vector<RigidBody>& bodies = late_[k] ? end_ : start_;
    Contact c = points_[k];
    if (late_[k]) follow(end_[c.a], end_[c.b], c);
    const bool rubs = c.friction > 0.0;
    problem.cones.push_back({.kind = rubs ? ConeKind::Friction : ConeKind::Push,
                             .row = static_cast<int>(problem.rows.size()),
                             .mu = c.friction});
    const double gap = std::max(points_[k].point.separation, 0.0);
    problem.rows.push_back(pointRow(bodies, c.a, c.b, c.point.p, c.point.n, gap / h));
    owner.push_back(k);
    if (!rubs) continue;
    Vec3 t1, t2;
    tangents(c.point.n, slipVelocity(start_[c.a], start_[c.b], points_[k].point), t1, t2);
    for (const Vec3& t : {t1, t2})
      problem.rows.push_back(pointRow(bodies, c.a, c.b, c.point.p, t, 0.0)), owner.push_back(k);
  }
  Solution solution;
  residual = 0.0;
  if (!problem.cones.empty())
    residual = solveByIslands(*findSolver("newton"), problem, {}, solution).residual;
  push(problem, solution, owner);
}

void Crossing::push(const Problem& problem, const Solution& solution,
                    std::span<const std::size_t> owner) {
  moved_ = start_;
  kicked_.assign(start_.size(), 0);
  given_.assign(points_.size(), Vec3::Zero());
  for (std::size_t r = 0; r < owner.size(); ++r) {
    const Row& row = problem.rows[r];
    const double size = solution.lambda[r];
    if (size == 0.0) continue;
    given_[owner[r]] += size * row.linear;
    const auto give = [&](int i, const Vec3& linear, const Vec3& angular) {
      if (start_[i].fixed()) return;
      moved_[i].P += size * linear;
      if (!moved_[i].particle) moved_[i].L += size * angular;
      kicked_[i] = 1;
    };
    give(row.a, row.linear, row.angularA);
    give(row.b, -row.linear, row.angularB);
  }
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    if (kicked_[i]) moved_[i].P += h * state_.exact.outer[i];
    updateVelocities(moved_[i]);
  }
  lostNormal_ = lostSlip_ = givenWork_ = 0.0;
  for (std::size_t r = 0, cone = 0; r < owner.size(); ++r) {
    const Row& row = problem.rows[r];
    while (cone + 1 < problem.cones.size() && problem.cones[cone + 1].row <= static_cast<int>(r))
      ++cone;
    const auto twist = [&](int i) {
      Vec6 v;
      v << moved_[i].v, moved_[i].omega;
      return v;
    };
    const double power = solution.lambda[r] * rowSpeed(row, twist(row.a), twist(row.b));
    (problem.cones[cone].row == static_cast<int>(r) ? lostNormal_ : lostSlip_) -= power;
    for (const int side : {0, 1}) {
      const int i = side == 0 ? row.a : row.b;
      if (!start_[i].fixed()) continue;
      const Vec3 linear = side == 0 ? row.linear : Vec3(-row.linear);
      const Vec3& angular = side == 0 ? row.angularA : row.angularB;
      givenWork_ -= solution.lambda[r] * (linear.dot(moved_[i].v) + angular.dot(moved_[i].omega));
    }
  }
}

void Crossing::drift() {
  for (int i = 0; i < model_.count(); ++i)
    end_[i] = across(model_, state_, start_[i], i, moved_[i].P, moved_[i].L, kicked_[i], h);
}

bool Crossing::bendsIn() {
  const double off = kOff * ContactTolerance::scaleOf(model_.size);
  bool any = false;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (!active_[k]) continue;
    Contact c = points_[k];
    follow(end_[c.a], end_[c.b], c);
    if (!late_[k] && c.point.separation >= std::min(0.0, points_[k].point.separation) - off)
      continue;
    late_[k] = 1;
    any = true;
  }
  return any;
}

bool Crossing::absorb(double& first) {
  const double off = kOff * ContactTolerance::scaleOf(model_.size);
  bool any = false;
  first = h;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (active_[k]) continue;
    Contact c = points_[k];
    const RigidBody &a = end_[c.a], &b = end_[c.b];
    follow(a, b, c);
    if (c.point.separation >= -off) continue;
    const double fall = (pull(c.a) + pull(c.b)) * h, vrel = approachVelocity(a, b, c.point);
    if (-c.restitution * vrel <= fall) {
      active_[k] = 1;
      any = true;
    } else {
      const double gap = points_[k].point.separation;
      first = std::min(first, h * gap / (gap - c.point.separation));
    }
  }
  return any;
}

/// When a pair touches that does not yet, if that is within the step.
double Crossing::firstTouch() const {
  const double touch = ContactTolerance::forSize(model_.size).touch;
  double first = h;
  std::vector<RigidBody> scratch = start_;
  for (const Pair& pair : pairs_) {
    if (pair.touches) continue;
    const auto flightOf = [&](int i) {
      RigidBody body = start_[i];
      if (kicked_[i]) {
        body.P = end_[i].P;
        body.L = end_[i].L;
        updateDerived(body);
        return Flight(body, Vec3::Zero(), 0.0);
      }
      return Flight(body, body.invM * state_.exact.outer[i], 0.0);
    };
    const Flight flightA = flightOf(pair.a), flightB = flightOf(pair.b);
    constexpr double kShare = 1e-2;  // of the touch
    first = tumble::firstTouch({flightA, state_.exact.parts[pair.a], scratch[pair.a]},
                               {flightB, state_.exact.parts[pair.b], scratch[pair.b]},
                               kShare * touch, first);
  }
  return first;
}

void Crossing::take(double most) {
  h = most;
  findPairs(most);
  findPoints(most);
  if (touches) {  // a hit that rebounds comes first
    h = 0.0;
    return;
  }
  double before = std::numeric_limits<double>::infinity();
  for (int cut = 0;; ++cut) {
    late_.assign(points_.size(), 0);
    solve();
    drift();
    for (int pass = 0; pass < kBends && bendsIn(); ++pass) {
      solve();
      drift();
    }
    double first = h;
    if (absorb(first)) continue;
    first = std::min(first, firstTouch());
    if (cut >= kCuts) break;
    if (first < h) {
      touches = true;
      constexpr double kShortest = 1e-3;  // of a crossing
      h = std::max(first, kShortest * h);
    } else if (const double deep = overlap(); deep > kDeep * state_.exact.pace.slackness() *
                                                         ContactTolerance::scaleOf(model_.size) &&
                                              deep < kEases * before) {
      before = deep;
      touches = false;
      h *= kShorter;
    } else {
      break;
    }
  }
  mend();
  keepBooks();
}

}  // namespace tumble
