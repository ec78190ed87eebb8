// Position projection: the least displacement, weighed by mass, that lifts what overlaps.
#include <algorithm>

#include "sim/body/force.h"
#include "sim/contact/rows.h"
#include "sim/math/rotation.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {

void Stepping::project() {
  constexpr int kRounds = 10;
  double deepest = deepestOverlap();
  const auto potential = [&] {
    return potentialEnergy(model_.def.gravity, model_.def.forces, state_.bodies);
  };
  const auto open = [&] { return deepest > tolerance_.drift || largestGap() > tolerance_.drift; };
  const bool lifts = open();
  const double before = lifts ? potential() : 0.0;
  for (int round = 0; round < kRounds && open(); ++round) {
    lift();
    deepest = deepestOverlap();
  }
  if (lifts) report_.certificate.energy_added_repair += potential() - before;
  report_.certificate.max_penetration = std::max(report_.certificate.max_penetration, deepest);
}

double Stepping::deepestOverlap() {
  double deepest = 0.0;
  for (std::size_t k = 0; k < state_.near.size(); ++k) {
    look(k, memory_.pairs[k].margin);
    deepest = std::max(deepest, memory_.pairs[k].deepest);
  }
  return deepest;
}

void Stepping::lift() {
  // Displacements obey the problem of the velocities with the gap as bias:
  //   separation + J Δ ≥ 0,  λ ≥ 0,  complementary,  M Δ = Jᵀ λ.
  constexpr double kTolerance = 1e-4;  // of the deepest overlap: the next round sees the rest
  beginVelocityProblem(state_.bodies, problem_);
  for (Vec6& v : problem_.vStar) v.setZero();
  for (const PairMemory& pair : memory_.pairs) {
    for (const Touch& touch : pair.touches) {
      const Contact& c = touch.contact;
      problem_.cones.push_back(
          {.kind = ConeKind::Push, .row = static_cast<int>(problem_.rows.size())});
      problem_.rows.push_back(
          pointRow(state_.bodies, c.a, c.b, c.point.p, c.point.n, c.point.separation));
    }
  }
  liftBonds(state_.bodies, model_.joints, bonds_);
  appendBonds(bonds_, problem_);
  solution_.lambda.clear();
  solution_.v.clear();
  solveByIslands(solver_, problem_, {.tolerance = kTolerance, .maxIterations = 200}, solution_);

  // Poses move, momenta stay: no kinetic energy comes of it. A turn is kept within a small angle.
  constexpr double kLargestTurn = 0.1;  // [rad]
  for (std::size_t i = 0; i < state_.bodies.size(); ++i) {
    RigidBody& body = state_.bodies[i];
    if (body.fixed() || solution_.v[i].isZero(0.0)) continue;
    Vec3 turn = solution_.v[i].tail<3>();
    if (turn.norm() > kLargestTurn) turn *= kLargestTurn / turn.norm();
    body.x += solution_.v[i].head<3>();
    body.q = rotated(body.q, turn).normalized();
    updateDerived(body);
  }
}

}  // namespace tumble
