// How a step across events ends: overlaps mended, books kept, and the way between its ends.
#include <algorithm>

#include "sim/collide/collide.h"
#include "sim/contact/rows.h"
#include "sim/math/rotation.h"
#include "sim/method/exact/crossing.h"
#include "sim/method/method.h"

namespace tumble {
namespace {

/// Passes over the overlaps that a step leaves.
constexpr int kMends = 8;
/// [m] per size of the world: points that near may come to overlap where others are taken apart.
constexpr double kNear = 1e-6;

}  // namespace

/// [m] of the pairs that are near, at the end.
double Crossing::overlap() {
  found_.clear();
  const double near = kNear * ContactTolerance::scaleOf(model_.size);
  for (const Pair& pair : pairs_) findContacts(model_, end_, {pair.b, pair.a}, near, found_);
  double least = 0.0;
  for (const Contact& c : found_) least = std::min(least, c.point.separation);
  return -least;
}

// The least way, weighed by mass, that takes all points apart.
void Crossing::mend() {
  const double off = kOff * ContactTolerance::scaleOf(model_.size);
  const auto energy = [&] {
    return kineticEnergy(end_) + potentialEnergy(model_.def.gravity, model_.def.forces, end_);
  };
  const double before = energy();
  const auto deepestOf = [&] {
    return *std::min_element(found_.begin(), found_.end(), [](const Contact& c, const Contact& d) {
      return c.point.separation < d.point.separation;
    });
  };
  Problem problem;
  for (int pass = 0; pass < kMends; ++pass) {
    const double deep = overlap();
    if (deep <= off) break;
    if (deep > deepest) worst = deepestOf();
    deepest = std::max(deepest, deep);
    beginVelocityProblem(end_, problem);
    for (Vec6& v : problem.vStar) v.setZero();
    for (const Contact& c : found_) {
      problem.cones.push_back(
          {.kind = ConeKind::Push, .row = static_cast<int>(problem.rows.size())});
      problem.rows.push_back(pointRow(end_, c.a, c.b, c.point.p, c.point.n, c.point.separation));
    }
    Solution way;
    solveByIslands(*findSolver("newton"), problem, {}, way);
    for (std::size_t i = 0; i < end_.size(); ++i) {
      RigidBody& body = end_[i];
      if (body.fixed()) continue;
      body.x += way.v[i].head<3>();
      if (!body.particle) body.q = rotated(body.q, way.v[i].tail<3>());
      updateDerived(body);
    }
  }
  mended = energy() - before;
  left = overlap();
  if (left > off) worst = deepestOf();
}

void Crossing::keepBooks() {
  for (int i = 0; i < model_.count(); ++i) {
    const RigidBody &from = start_[i], &to = end_[i];
    if (from.fixed()) continue;
    if (model_.def.bodies[i].pivot_B) {
      impulse += to.P - from.P;
      continue;
    }
    impulse += h * state_.exact.outer[i];
    const Vec3 way = kicked_[i] ? Vec3(h * from.invM * to.P) : Vec3(to.x - from.x);
    work += (state_.exact.outer[i] - from.M * model_.def.gravity).dot(way);
    if (!kicked_[i]) continue;
    const Vec3 dP = to.P - from.P, dL = to.L - from.L;
    lostImpact += 0.5 * (from.invM * dP.squaredNorm() + dL.dot(from.Iinv * dL));
  }
  lostImpact += lostNormal_;
  lostFriction = lostSlip_;
  work += givenWork_;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (model_.fixed(points_[k].b)) impulse += given_[k];
    if (model_.fixed(points_[k].a)) impulse -= given_[k];
  }
  segment = {.t0 = state_.t, .t1 = state_.t + h, .start = start_, .end = end_, .contacts = {}};
  segment.crossing = true;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (given_[k].isZero(0.0)) continue;
    Contact c = points_[k];
    c.force = given_[k] / h;
    c.lasting = true;
    const Vec3 slip = slipVelocity(moved_[c.a], moved_[c.b], c.point);
    c.sliding = c.friction > 0.0 && slip.norm() > ContactTolerance::forSize(model_.size).stick;
    if (c.sliding) c.slipDirection = slip.normalized();
    segment.contacts.push_back(c);
  }
}

void lookAcross(const Model& model, const State& state, const Segment& segment, double t,
                std::vector<RigidBody>& bodies) {
  std::vector<char> kicked(segment.start.size(), 0);
  for (const Contact& c : segment.contacts)
    for (const int i : {c.a, c.b}) kicked[i] = !model.fixed(i);
  const double s = t - segment.t0, part = s / (segment.t1 - segment.t0);
  bodies = segment.start;
  for (int i = 0; i < model.count(); ++i) {
    const RigidBody &from = segment.start[i], &to = segment.end[i];
    RigidBody& body = bodies[i];
    body = across(model, state, from, i, to.P, to.L, kicked[i], s);
    if (!kicked[i]) continue;
    // What is between is shown between, so that energy is no more than at the ends.
    body.P = from.P + part * (to.P - from.P);
    body.L = from.L + part * (to.L - from.L);
    updateDerived(body);
  }
}

}  // namespace tumble
