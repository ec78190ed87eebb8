// Positions that are not legal: what a step that went on into an overlap leaves to be mended.
#include <algorithm>
#include <cmath>

#include "sim/collide/collide.h"
#include "sim/contact/rows.h"
#include "sim/math/rotation.h"
#include "sim/method/course/course.h"

namespace tumble {
void Course::mend() {
  constexpr int kRounds = 20;  // turns bend the way out of an overlap
  noteMissteps(state_.bodies, state_.t);
  const double share = plan_.share(model_.def.course);
  if (deepestOverlap() > tolerance_.touch) {
    const double before = energy();
    const int rounds = share < 1.0 ? 1 : kRounds;
    for (int round = 0; round < rounds && deepestOverlap() > tolerance_.root; ++round) {
      lift(share);
      findTouching();
    }
    report_.certificate.energy_added_repair += energy() - before;
    if (share == 1.0 && deepestOverlap() > tolerance_.touch)
      report_.note("some overlaps were not mended at once; max_penetration has the worst");
  }
  closeMissteps(state_.bodies, state_.t);
}

double Course::deepestOverlap() const {
  double deepest = 0.0;
  for (const Contact& c : touching_) deepest = std::max(deepest, -c.point.separation);
  return deepest;
}

double Course::energy() const {
  return kineticEnergy(state_.bodies) +
         potentialEnergy(model_.def.gravity, model_.def.forces, state_.bodies);
}

void Course::lift(double share) {
  // Displacements Δ obey the problem of the velocities with the gap, or the share of an overlap, as
  // bias:  bias + J Δ ≥ 0,  λ ≥ 0,  complementary,  M Δ = Jᵀ λ.
  beginVelocityProblem(state_.bodies, lift_);
  for (Vec6& v : lift_.vStar) v.setZero();
  for (const Contact& c : touching_) {
    const double gap = c.point.separation;
    lift_.cones.push_back({.kind = ConeKind::Push, .row = static_cast<int>(lift_.rows.size())});
    lift_.rows.push_back(
        pointRow(state_.bodies, c.a, c.b, c.point.p, c.point.n, gap < 0.0 ? share * gap : gap));
  }
  lifted_.lambda.clear();
  solveByIslands(*findSolver("pivoting"), lift_, {}, lifted_);

  // Poses move, momenta stay. A turn is kept within a small angle.
  constexpr double kLargestTurn = 0.1;  // [rad]
  for (std::size_t i = 0; i < state_.bodies.size(); ++i) {
    RigidBody& body = state_.bodies[i];
    if (body.fixed() || lifted_.v[i].isZero(0.0)) continue;
    Vec3 turn = lifted_.v[i].tail<3>();
    if (turn.norm() > kLargestTurn) turn *= kLargestTurn / turn.norm();
    body.x += lifted_.v[i].head<3>();
    if (!body.particle) body.q = rotated(body.q, turn).normalized();
    updateDerived(body);
  }
}

void Course::noteMissteps(std::span<const RigidBody> bodies, double t) {
  for (const auto& [b, a] : state_.near) {
    if (report_.missteps.size() >= kMostMissteps) break;
    const double gap =
        separation(model_.shapes[a], bodies[a].pose(), model_.shapes[b], bodies[b].pose());
    const auto open = [&, a = a, b = b](const Misstep& m) {
      return std::isinf(m.mendedAt) &&
             ((m.body == a && m.other == b) || (m.body == b && m.other == a));
    };
    if (gap >= -tolerance_.touch ||
        std::any_of(report_.missteps.begin(), report_.missteps.end(), open))
      continue;
    for (const auto& [body, other] : {std::pair(a, b), std::pair(b, a)})
      if (!bodies[body].fixed())
        report_.missteps.push_back(
            {.t = t, .body = body, .other = other, .separation = gap, .pose = bodies[body].pose()});
  }
}

void Course::closeMissteps(std::span<const RigidBody> bodies, double t) {
  for (Misstep& m : report_.missteps) {
    if (std::isfinite(m.mendedAt)) continue;
    const double gap = separation(model_.shapes[m.body], bodies[m.body].pose(),
                                  model_.shapes[m.other], bodies[m.other].pose());
    if (gap < -tolerance_.touch) continue;
    m.mendedAt = t;
    m.mended = bodies[m.body].pose();
  }
}

}  // namespace tumble
