#include "sim/contact/rest.h"

#include <algorithm>
#include <cmath>

#include "sim/contact/rows.h"
#include "sim/problem/cone.h"
#include "sim/problem/polish.h"

namespace tumble {
namespace {

/// Factorizations above which a problem is hard, and rows up to which dense steps are cheaper.
constexpr int kHard = 40;
constexpr std::size_t kDense = 60;
/// By how much more than a moment ago may be left of a hard problem.
constexpr double kHardlyMore = 2.0;
/// Residual above which no forces obey the laws: no more than a moment ago may be left then.
constexpr double kLost = 1e-3;
/// Rows of an island up to which a dense factor takes less than a second.
constexpr std::size_t kFewRows = 600;
/// Residual that rounding leaves: what draws gaps of joints shut holds their rounding, by the
/// square of the time in which it does.
constexpr double kFree = 1e-12, kJoined = 1e-10;

/// The last digits of forces, where there are few.
SolveReport polishFew(const Problem& problem, const SolveSettings& settings, Solution& solution) {
  if (problem.rows.size() <= kFewRows) return polish(problem, settings, solution);
  const double left = naturalResidual(problem, solution);
  const bool solved = left <= settings.tolerance || atRounding(problem, solution, left);
  return {solved ? SolveStatus::Solved : SolveStatus::NotConverged, left, 0};
}
constexpr Solver kPolish{.name = "polish", .summary = "", .solve = polishFew};

bool hasJoints(const Problem& problem) {
  return std::any_of(problem.cones.begin(), problem.cones.end(),
                     [](const Cone& c) { return c.kind == ConeKind::Equality; });
}

/// slipAccelerationBias as it is seen by an observer who turns with the two bodies, at their mean
/// ω. What sticks has a slip of rounding and of steps, δ × r of a face that turns with the bodies:
/// in the world there are no accelerations by which it fades at all points of the face at once, as
/// δ × (ω × r) is no motion of a rigid body.
double stickAccelerationBias(const RigidBody& a, const RigidBody& b, const ContactPoint& c,
                             const Vec3& t) {
  const Vec3 turn = 0.5 * (a.omega + b.omega);
  return slipAccelerationBias(a, b, c, t) - t.dot(turn.cross(slipVelocity(a, b, c)));
}

}  // namespace

Vec3 slidingDirection(std::span<const RigidBody> bodies, const Contact& contact) {
  const Vec3 slip = slipVelocity(bodies[contact.a], bodies[contact.b], contact.point);
  const double along = slip.dot(contact.slipDirection), size = slip.norm();
  if (contact.creeping || size <= 0.0 || std::abs(along) < 0.5 * size) {
    Vec3 t1, t2;  // the direction of the start, in the tangent plane of now
    tangents(contact.point.n, contact.slipDirection, t1, t2);
    return t1;
  }
  return along > 0.0 ? Vec3(slip / size) : Vec3(-slip / size);
}

void setPull(const RigidBody& a, const RigidBody& b, double tau, Contact& c) {
  c.pull =
      2.0 / tau * approachVelocity(a, b, c.point) + (c.point.separation + c.granted) / (tau * tau);
  c.slipPull = slipVelocity(a, b, c.point) / tau;
}

void RestForces::addRows(std::span<const RigidBody> bodies, const Contact& contact) {
  const RigidBody &a = bodies[contact.a], &b = bodies[contact.b];
  const ContactPoint& c = contact.point;
  const double bias = normalAccelerationBias(a, b, c) + contact.pull;
  problem_.cones.push_back(
      {.kind = ConeKind::Push, .row = static_cast<int>(problem_.rows.size()), .mu = 0.0});
  problem_.rows.push_back(pointRow(bodies, contact.a, contact.b, c.p, c.n, bias));
  if (contact.friction <= 0.0) return;
  if (!contact.sliding) return addFrictionRows(bodies, contact);

  const Vec3 t = slidingDirection(bodies, contact);
  problem_.cones.back().kind = ConeKind::Slide;
  problem_.cones.back().mu = contact.friction;
  problem_.rows.push_back(
      pointRow(bodies, contact.a, contact.b, c.p, t, slipAccelerationBias(a, b, c, t)));
}

void RestForces::addFrictionRows(std::span<const RigidBody> bodies, const Contact& contact) {
  const RigidBody &a = bodies[contact.a], &b = bodies[contact.b];
  const ContactPoint& c = contact.point;
  const Vec3 way = problem_.vStar[contact.a].head<3>() - problem_.vStar[contact.b].head<3>();
  Vec3 t1, t2;
  tangents(c.n, way, t1, t2);
  for (const Vec3& t : {t1, t2}) {
    const double bias = stickAccelerationBias(a, b, c, t) + contact.slipPull.dot(t);
    problem_.rows.push_back(pointRow(bodies, contact.a, contact.b, c.p, t, bias));
  }
  problem_.cones.back().kind = ConeKind::Friction;
  problem_.cones.back().mu = contact.friction;
}

SolveReport RestForces::solve(std::span<const Contact> contacts, double misfit) {
  const bool friction = std::any_of(contacts.begin(), contacts.end(),
                                    [](const Contact& c) { return c.friction > 0.0; });
  if (hard_ && solution_.lambda.size() == problem_.rows.size()) {
    const double tolerance = hasJoints(problem_) ? kJoined : kFree;
    const SolveReport report = polish(problem_, {.tolerance = tolerance}, solution_);
    if (report.status == SolveStatus::Solved ||
        report.residual <= (left_ > kLost ? 1.0 : kHardlyMore) * left_)
      return report;
  }
  const SolveReport report = solveAnew(friction, misfit);
  const bool easy = report.status == SolveStatus::Solved && report.iterations <= kHard;
  hard_ = friction && !easy && problem_.rows.size() <= kDense;
  left_ = report.residual;
  return report;
}

SolveReport RestForces::solveAnew(bool friction, double misfit) {
  // What a solver leaves is in the certificate. Where forces have no end, pivoting says so; and it
  // bears joints under any load, with what leans on them.
  solution_ = {};             // the same answer whatever was solved before
  constexpr int kMost = 200;  // factorizations, pivots or sweeps
  constexpr double kGaps = 10.0;
  const bool joined = hasJoints(problem_);
  // Rows of joints that repeat each other do so but for the square of the gaps that are open.
  const SolveSettings settings{.tolerance = joined ? kJoined : kFree,
                               .maxIterations = kMost,
                               .dependent = kGaps * misfit * misfit};
  const Solver& first = *findSolver(joined && !friction ? "pivoting" : "newton");
  SolveReport report = solveByIslands(first, problem_, settings, solution_);
  if (polished_ && friction) report = solveByIslands(kPolish, problem_, {}, solution_);
  if (friction || report.status == SolveStatus::Solved) return report;
  solution_ = {};
  return solveByIslands(*findSolver("pivoting"), problem_, settings, solution_);
}

Vec3 RestForces::force(std::size_t contact) const {
  const Cone& cone = problem_.cones[contact];
  Vec3 sum = Vec3::Zero();
  for (int r = cone.row; r < cone.row + coneRows(cone.kind); ++r)
    sum += solution_.lambda[r] * problem_.rows[r].linear;
  return sum;
}

SolveReport RestForces::apply(std::span<RigidBody> bodies, std::span<Contact> contacts,
                              Bonds* bonds) {
  const bool bound = bonds && !bonds->empty();
  if (contacts.empty() && !bound) return {};
  beginAccelerationProblem(bodies, problem_);
  for (const Contact& contact : contacts) addRows(bodies, contact);
  const std::size_t firstBond = problem_.rows.size();
  if (bound) appendBonds(*bonds, problem_);
  const SolveReport report = solve(contacts, bound ? bonds->misfit : 0.0);
  if (bound) {
    readBonds(solution_.lambda, firstBond, *bonds);
    addBondForces(*bonds, bodies);
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Contact& contact = contacts[i];
    contact.force = force(i);
    applyForce(bodies[contact.a], contact.point.p, contact.force);
    applyForce(bodies[contact.b], contact.point.p, -contact.force);
  }
  return report;
}

void RestForces::settleCreep(std::span<const RigidBody> bodies, std::span<const RigidBody> ends,
                             std::span<Contact> contacts, double h, const Bonds* bonds) {
  beginAccelerationProblem(bodies, problem_);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    problem_.vStar[i] *= h;
    problem_.vStar[i].head<3>() += bodies[i].v;
    problem_.vStar[i].tail<3>() += bodies[i].omega;
  }
  for (Contact c : contacts) {
    follow(ends[c.a], ends[c.b], c);
    c.sliding = c.sliding && !c.creeping;
    addRows(ends, c);
  }
  const bool bound = bonds && !bonds->empty();
  if (bound) appendBonds(*bonds, problem_);
  for (Row& row : problem_.rows) row.bias = 0.0;  // velocities, not accelerations
  solveAnew(true, bound ? bonds->misfit : 0.0);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Contact& c = contacts[i];
    if (!c.creeping) continue;
    const Vec3 f = force(i), tangential = f - f.dot(c.point.n) * c.point.n;
    const Vec3 slip = slipVelocity(bodies[c.a], bodies[c.b], c.point);
    constexpr double kEdge = 1e-9;  // of the cone: nearer is on its edge
    const bool saturated = tangential.norm() >= c.friction * f.dot(c.point.n) * (1.0 - kEdge);
    // A slip that will end within the step keeps its line, so that the instant of its end is found.
    const bool turnsRound = saturated && tangential.dot(slip) < 0.0;
    if (turnsRound) c.slipDirection = -tangential.normalized();
    c.mayStick = c.mayStick && !turnsRound;
  }
}

}  // namespace tumble
