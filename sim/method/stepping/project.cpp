// Position projection: the least displacement, weighed by mass, that lifts what overlaps.
#include <algorithm>

#include "sim/contact/rows.h"
#include "sim/math/rotation.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {

bool Stepping::project() {
  const StageScope stage(state_.times, StepStage::Lifting);
  constexpr int kRounds = 10, kSwept = 3;  // by the solver of crowds, if all is lifted
  constexpr int kDrafted = 2;
  double deepest = deepestOverlap();
  double gap = largestGap();
  const auto isOpen = [&] { return deepest > mayOverlap() || gap > tolerance_.drift; };
  const bool lifts = isOpen();
  const double before = lifts ? potentialNow() : 0.0;
  int left = model_.def.stepping.iterations;  // of the solver, for all rounds
  const auto rounds = [&] { return isDrafted() && gap <= tolerance_.drift ? kDrafted : kRounds; };
  for (int round = 0; isOpen() && left > 0 && round < rounds(); ++round) {
    left -= lift(std::max(deepest, gap), left, rough_ && (leftOpen_ > 0.0 || round < kSwept));
    deepest = deepestOverlap();
    gap = largestGap();
  }
  if (lifts) report_.certificate.energy_added_repair += potentialNow() - before;
  report_.certificate.max_penetration = std::max(report_.certificate.max_penetration, deepest);
  return !isOpen();
}

double Stepping::deepestOverlap() {
  const StageScope stage(state_.times, StepStage::Points);
  for (std::size_t k = 0; k < state_.near.size(); ++k)
    look(k, std::max(memory_.pairs[k].margin, tolerance_.touch));
  return deepestKnown();
}

double Stepping::deepestKnown() const {
  double deepest = 0.0;
  for (std::size_t k = 0; k < memory_.pairs.size(); ++k)
    if (!findsInside(k)) deepest = std::max(deepest, memory_.pairs[k].deepest);
  return deepest;
}

/// Joins to islands what touches or is near, and marks the roots of those with an overlap.
void Stepping::findOverlapping() {
  partBodies();
  for (std::size_t k = 0; k < state_.near.size(); ++k)
    if (!memory_.pairs[k].touches.empty()) joinBodies(state_.near[k].second, state_.near[k].first);
  for (const Joint& joint : joints()) joinBodies(joint.a, joint.b);
  work_.open.assign(state_.bodies.size(), 0);
  for (std::size_t k = 0; k < state_.near.size(); ++k)
    if (memory_.pairs[k].deepest > tolerance_.drift && !findsInside(k)) work_.open[rootOf(k)] = 1;
}

int Stepping::rootOf(std::size_t pair) {
  const auto [b, a] = state_.near[pair];
  return islandRoot(work_.root, model_.fixed(a) ? b : a);
}

int Stepping::lift(double furthest, int most, bool asCrowd) {
  // Displacements obey the problem of the velocities with the gap as bias:
  //   separation + J Δ ≥ 0,  λ ≥ 0,  complementary,  M Δ = Jᵀ λ.
  constexpr int kMost = 200, kMostOfCrowd = 20;  // iterations of one round
  constexpr double kTolerance = 1e-4;  // of the deepest overlap: the next round sees the rest
  // What is lifted goes about as far as it overlaps: wider gaps are not asked to stay, and the next
  // round sees one that closed. Where overlap may be left alone, only the narrowest are.
  constexpr double kFar = 100.0, kNearby = 1.0;  // of the furthest
  const int atMost = std::min(most, asCrowd ? kMostOfCrowd : kMost);
  const double reach = (asCrowd && isHasty() ? kNearby : kFar) * furthest;
  beginVelocityProblem(state_.bodies, work_.problem);
  for (Vec6& v : work_.problem.vStar) v.setZero();
  findOverlapping();
  for (std::size_t k = 0; k < memory_.pairs.size(); ++k) {
    if (memory_.pairs[k].touches.empty() || findsInside(k) || !work_.open[rootOf(k)]) continue;
    for (const Touch& touch : memory_.pairs[k].touches) {
      const Contact& c = touch.contact;
      if (c.point.separation > reach) continue;
      work_.problem.cones.push_back(
          {.kind = ConeKind::Push, .row = static_cast<int>(work_.problem.rows.size())});
      work_.problem.rows.push_back(
          pointRow(state_.bodies, c.a, c.b, c.point.p, c.point.n, c.point.separation));
    }
  }
  liftBonds(state_.bodies, joints(), work_.bonds);
  appendBonds(work_.bonds, work_.problem);
  work_.solution.lambda.clear();
  work_.solution.v.clear();
  const SolveReport solved = solveByIslands(
      asCrowd ? *findSolver(model_.def.stepping.crowdSolver) : solver_, work_.problem,
      {.tolerance = kTolerance, .maxIterations = atMost}, work_.solution);

  report_.certificate.spin_added_repair += spinOfLifted();
  // Poses move, momenta stay: no kinetic energy comes of it. A turn is kept within a small angle.
  constexpr double kLargestTurn = 0.1;  // [rad]
  for (std::size_t i = 0; i < state_.bodies.size(); ++i) {
    RigidBody& body = state_.bodies[i];
    if (body.fixed() || work_.solution.v[i].isZero(0.0)) continue;
    Vec3 turn = work_.solution.v[i].tail<3>();
    if (turn.norm() > kLargestTurn) turn *= kLargestTurn / turn.norm();
    body.x += work_.solution.v[i].head<3>();
    body.q = rotated(body.q, turn).normalized();
    updateDerived(body);
  }
  return solved.iterations;
}

/// Who is lifted by d and keeps its momentum P has d × P more angular momentum. What a fixed body
/// lifts is not free.
double Stepping::spinOfLifted() {
  const int world = static_cast<int>(state_.bodies.size());
  const auto stands = [&](int i) { return i == world || model_.fixed(i); };
  work_.given.assign(state_.bodies.size(), Vec3::Zero());
  work_.free.assign(state_.bodies.size(), 1);
  for (std::size_t r = 0; r < work_.problem.rows.size(); ++r) {
    const Row& row = work_.problem.rows[r];
    if (work_.solution.lambda[r] != 0.0 && stands(row.a) != stands(row.b))
      work_.free[islandRoot(work_.root, stands(row.a) ? row.b : row.a)] = 0;
  }
  for (const int i : work_.active)
    if (!model_.fixed(i))
      work_.given[islandRoot(work_.root, i)] +=
          work_.solution.v[i].head<3>().cross(state_.bodies[i].P);
  double sum = 0.0;
  for (const int i : work_.active)
    if (work_.free[i]) sum += work_.given[i].norm();
  return sum;
}

}  // namespace tumble
