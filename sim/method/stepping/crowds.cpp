// Crowds: near bodies that more contacts join than reflections are for. They are struck once a
// step, for all that meets within it; what would rebound for less than a step lasts. Islands of
// many contacts that move are solved as far as is planned for them. In a draft a hit is a row of
// the step's contact problem, which gives back what restitution asks for.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/contact/impact.h"
#include "sim/method/stepping/stepping.h"
#include "sim/problem/cone.h"
#include "sim/problem/equalities.h"
#include "sim/problem/row.h"

namespace tumble {
namespace {

constexpr std::size_t kSmall = 128;  ///< contacts that cost little to be solved to the end

/// The largest s from 0 to 1 with  s slope + ½ s² curvature ≤ most.
double mostAlong(double slope, double curvature, double most) {
  return std::clamp((std::sqrt(slope * slope + 2.0 * curvature * most) - slope) / curvature, 0.0,
                    1.0);
}

}  // namespace

int Stepping::weightOf(const PairMemory& pair) {
  return weightOfContacts(static_cast<int>(pair.touches.size()),
                          pair.touches.front().contact.friction);
}

bool Stepping::isCrowd(const Island& island) const {
  int weight = 0;
  bool bounces = model_.def.stepping.anyCrowd;
  for (const Link link : island.links) {
    if (!isPair(link) || memory_.pairs[link].touches.empty()) continue;
    bounces = bounces || memory_.pairs[link].bounces;
    weight += weightOf(memory_.pairs[link]);
  }
  return bounces && weight > kReflectionsReach;
}

/// One body or two among many faces have many points near and strike few of them.
void Stepping::findCrowds() {
  constexpr int kFew = 2;
  const auto touches = [](const PairMemory& pair) { return !pair.touches.empty(); };
  many_ = crowd_ = mixed_ = false;
  work_.dense.resize(state_.bodies.size());
  work_.crowded.resize(state_.bodies.size());
  for (const int i : work_.active) work_.dense[i] = work_.crowded[i] = 0;
  int sum = 0;
  for (const PairMemory& pair : memory_.pairs)
    if (touches(pair)) sum += weightOf(pair);
  if (sum <= kReflectionsReach) return;

  partBodies();
  for (const auto& [b, a] : state_.near) joinBodies(a, b);
  std::vector<int>&weight = work_.island, &members = work_.number;  // per root
  weight.resize(state_.bodies.size());
  members.resize(state_.bodies.size());
  for (const int i : work_.active) weight[i] = members[i] = 0;
  for (const int i : work_.active)
    if (!model_.fixed(i)) ++members[islandRoot(work_.root, i)];
  std::vector<char>& bounces = work_.open;  // per root
  bounces.assign(state_.bodies.size(), model_.def.stepping.anyCrowd ? 1 : 0);
  for (std::size_t k = 0; k < memory_.pairs.size(); ++k) {
    const PairMemory& pair = memory_.pairs[k];
    if (!touches(pair)) continue;
    const int root = rootOf(k);
    weight[root] += weightOf(pair);
    if (pair.bounces) bounces[root] = 1;
  }
  for (const int i : work_.active) {
    if (model_.fixed(i)) continue;
    const int root = islandRoot(work_.root, i);
    work_.dense[i] = members[root] > kFew && weight[root] > kReflectionsReach;
    work_.crowded[i] = work_.dense[i] && bounces[root];
    many_ = many_ || work_.dense[i];
    crowd_ = crowd_ || work_.crowded[i];
    mixed_ = mixed_ || !work_.crowded[i];
  }
  mixed_ = mixed_ && crowd_;
}

bool Stepping::strikesAsCrowd() const {
  return crowd_ && (model_.def.impact == "auto" || model_.def.impact == "crowd");
}

bool Stepping::isManyContacts(const Island& island) const {
  constexpr std::size_t kFew = 16;  // contacts that are solved as well as others
  return island.problem.cones.size() > kFew && !anyYields(island);
}

double Stepping::roughTolerance(const Island& island, double scale) const {
  constexpr double kMoves = 1e-6;  // of the largest speed
  const SteppingSettings& stepping = model_.def.stepping;
  const Problem& problem = island.problem;
  if (!isManyContacts(island) ||
      (stepping.crowdSolver == stepping.solver && stepping.crowdTolerance == stepping.tolerance))
    return 0.0;
  double fastest = 0.0;
  for (const Row& row : problem.rows)
    fastest = std::max(fastest,
                       std::abs(rowSpeed(row, island.solution.v[row.a], island.solution.v[row.b])));
  if (fastest <= kMoves * scale) return 0.0;
  return std::max(stepping.tolerance, stepping.crowdTolerance * std::min(1.0, fastest / scale));
}

void Stepping::takeBack(const Island& island) {
  for (const Link link : island.links)
    if (isPair(link))
      for (Touch& touch : memory_.pairs[link].touches) touch.due = std::max(touch.due, 0.0);
}

void Stepping::setAside(Island& island, double scale, double h) {
  constexpr double kFar = 0.1, kAside = -1.0;  // of the scale: few that part so fast are pushed
  const bool sets = isHasty() && !isBonded(island);
  if (!again_ || !sets) takeBack(island);
  if (!sets) return;
  Problem& problem = island.problem;
  std::size_t cone = 0, kept = 0;
  int rows = 0;
  for (const Link link : island.links) {
    for (Touch& touch : memory_.pairs[link].touches) {
      if (flies(touch, h)) continue;
      Cone of = problem.cones[cone++];
      const Row& normal = problem.rows[of.row];
      const double parts =
          rowSpeed(normal, problem.vStar[normal.a], problem.vStar[normal.b]) + normal.bias;
      if (!again_ && !closed(touch) && parts > kFar * scale) touch.due = kAside;
      if (isAside(touch)) {
        touch.impulse.setZero();
        touch.contact.force.setZero();
        touch.contact.sliding = touch.contact.lasting = false;
        continue;
      }
      for (int r = 0; r < coneRows(of.kind); ++r) problem.rows[rows + r] = problem.rows[of.row + r];
      of.row = rows;
      rows += coneRows(of.kind);
      problem.cones[kept++] = of;
    }
  }
  problem.rows.resize(rows);
  problem.cones.resize(kept);
  island.pull.clear();
}

void Stepping::startFromBefore(Island& island, double h) {
  island.solution.lambda.assign(island.problem.rows.size(), 0.0);
  std::size_t cone = 0;
  for (const Link link : island.links) {
    if (!isPair(link)) {
      ++cone;
      continue;
    }
    for (const Touch& touch : memory_.pairs[link].touches) {
      if (flies(touch, h) || isAside(touch)) continue;
      const Cone& of = island.problem.cones[cone++];
      const double longer = touch.length > 0.0 ? h / touch.length : 0.0;
      for (int r = of.row; r < of.row + coneRows(of.kind); ++r)
        island.solution.lambda[r] = longer * touch.impulse.dot(island.problem.rows[r].linear);
    }
  }
}

/// The energy of bodies that go through a step with v = vBefore + h M⁻¹F + s Δ, Δ = M⁻¹ Jᵀ λ,
/// changes by  −½ |h M⁻¹F|²_M + s λ·J vBefore + ½ s² λ·J Δ,  without the work of supports: J v is
/// relative.
bool Stepping::keepFromGaining(Island& island, double h) {
  Solution& solution = island.solution;
  const Problem& problem = island.problem;
  double slope = 0.0, curvature = 0.0, fall = 0.0;
  const auto before = [&](int local) -> const Vec6& { return work_.before[island.bodies[local]]; };
  for (const Cone& cone : problem.cones) {
    for (int r = cone.row; r < cone.row + coneRows(cone.kind); ++r) {
      const Row& row = problem.rows[r];
      const double star = rowSpeed(row, problem.vStar[row.a], problem.vStar[row.b]);
      slope += solution.lambda[r] * rowSpeed(row, before(row.a), before(row.b));
      curvature +=
          solution.lambda[r] * (rowSpeed(row, solution.v[row.a], solution.v[row.b]) - star);
    }
  }
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {
    const RigidBody& body = state_.bodies[island.bodies[i]];
    if (body.fixed() || solution.v[i] == problem.vStar[i]) continue;
    fall += 0.5 * h * h *
            (body.invM * body.force.squaredNorm() + body.torque.dot(body.Iinv * body.torque));
  }
  if (slope + 0.5 * curvature <= fall) return false;
  if (isBonded(island)) return pushLess(island, fall);
  const double part = mostAlong(slope, curvature, fall);
  for (double& lambda : solution.lambda) lambda *= part;
  velocitiesFromLambda(problem, solution.lambda, solution.v);
  return true;
}

/// The same between λ₀, which joints need where nothing pushes, and the λ found: joints hold all
/// the way, as their u is linear in λ.
bool Stepping::pushLess(Island& island, double fall) {
  constexpr int kAgain = 2;
  thread_local Equalities joints;
  Solution &found = island.solution, &alone = island.alone;
  const Problem& problem = island.problem;
  if (!joints.factor(problem, LeastSquares::kDependent)) return false;
  alone.lambda.assign(problem.rows.size(), 0.0);
  alone.v.resize(problem.vStar.size());
  for (int k = 0; k < kAgain; ++k) joints.solve(problem, alone.lambda);
  velocitiesFromLambda(problem, alone.lambda, alone.v);
  double slope = 0.0, curvature = 0.0;
  for (std::size_t r = 0; r < problem.rows.size(); ++r) {
    const Row& row = problem.rows[r];
    const auto speed = [&](std::span<const Vec6> v) { return rowSpeed(row, v[row.a], v[row.b]); };
    const double before =
        rowSpeed(row, work_.before[island.bodies[row.a]], work_.before[island.bodies[row.b]]);
    const double given = speed(alone.v) - speed(problem.vStar),
                 more = found.lambda[r] - alone.lambda[r];
    fall -= alone.lambda[r] * (before + 0.5 * given);
    slope += more * (before + given);
    curvature += more * (speed(found.v) - speed(alone.v));
  }
  fall = std::max(fall, 0.0);
  if (slope + 0.5 * curvature <= fall) return false;
  const double part = mostAlong(slope, curvature, fall);
  for (std::size_t r = 0; r < problem.rows.size(); ++r)
    found.lambda[r] = alone.lambda[r] + part * (found.lambda[r] - alone.lambda[r]);
  velocitiesFromLambda(problem, found.lambda, found.v);
  return true;
}

double Stepping::mayLeave(double scale, double h) const {
  const SteppingSettings& stepping = model_.def.stepping;
  return stepping.crowdOpen * h * scale * stepping.crowdTolerance;
}

bool Stepping::isFarOff(const Island& island, const SolveReport& solved, double tolerance) const {
  constexpr int kMeant = 100;      // sweeps: a plan of fewer takes what they leave
  constexpr double kFarOff = 5.0;  // times the tolerance
  return model_.def.stepping.crowdIterations >= kMeant && island.problem.cones.size() <= kSmall &&
         solved.residual > kFarOff * tolerance;
}

SolveReport Stepping::solveAsPlanned(Island& island, bool bent, bool crowd, double h) {
  const double scale = !bent && crowd ? velocityScale(island.problem) : 0.0;
  const double part = scale > 0.0 ? roughTolerance(island, scale) : 0.0;
  island.memory->rough = part > 0.0;
  if (island.memory->rough) {
    setAside(island, scale, h);
    return solveRough(island, part, h);
  }
  takeBack(island);
  if (scale > 0.0 && isDrafted() && isManyContacts(island) && island.problem.cones.size() > kSmall)
    return solveCalm(island, h);
  if (bent) startFromBefore(island, h);
  SolveReport solved = solveFine(island, fineTolerance(island));
  if (reboundsInStep() && anyRebounds(island) && keepFromGaining(island, h))
    solved.residual = naturalResidual(island.problem, island.solution);
  return solved;
}

bool Stepping::anyRebounds(const Island& island) const {
  return std::any_of(island.links.begin(), island.links.end(), [&](Link link) {
    return isPair(link) &&
           std::any_of(memory_.pairs[link].touches.begin(), memory_.pairs[link].touches.end(),
                       [](const Touch& touch) { return touch.rebounds; });
  });
}

SolveReport Stepping::solveCalm(Island& island, double h) {
  constexpr int kFewIterations = 20, kSteps = 8;
  if (step_ >= island.memory->sweptTo) {
    startFromBefore(island, h);
    const SolveReport solved =
        solver_.solve(island.problem,
                      {.tolerance = model_.def.stepping.tolerance, .maxIterations = kFewIterations},
                      island.solution);
    if (solved.status == SolveStatus::Solved) return solved;
    island.memory->sweptTo = step_ + kSteps;
  }
  island.memory->rough = true;
  return solveRough(island, model_.def.stepping.crowdTolerance, h);
}

/// What is left open is a velocity: that of a point of cloth is soon small, while the push behind
/// it still moves the heavy body that lies on it.
double Stepping::lightness(const Island& island) const {
  double heaviest = 0.0, lightest = std::numeric_limits<double>::infinity();
  for (const int i : island.movers) {
    const double mass = state_.bodies[i].M;
    if (model_.bends(i))
      lightest = std::min(lightest, mass);
    else
      heaviest = std::max(heaviest, mass);
  }
  return std::min(1.0, heaviest > 0.0 ? lightest / heaviest : 1.0);
}

double Stepping::fineTolerance(const Island& island) const {
  constexpr double kReach = 1e-12;  // what solvers reach
  const double asked = model_.def.stepping.tolerance;
  return std::min(asked, std::max(kReach, asked * lightness(island)));
}

SolveReport Stepping::solveFine(Island& island, double tolerance) {
  const SteppingSettings& stepping = model_.def.stepping;
  const SolveReport solved = solver_.solve(
      island.problem,
      {.tolerance = tolerance, .maxIterations = stepping.iterations, .pull = island.pull},
      island.solution);
  findCrushed(island, solved);
  if (solved.status != SolveStatus::Solved) island.memory->above = true;
  return solved;
}

SolveReport Stepping::solveRough(Island& island, double tolerance, double h) {
  const SteppingSettings& stepping = model_.def.stepping;
  startFromBefore(island, h);
  SolveReport solved =
      findSolver(stepping.crowdSolver)
          ->solve(island.problem,
                  {.tolerance = tolerance, .maxIterations = stepping.crowdIterations},
                  island.solution);
  if (solved.status != SolveStatus::Solved) {
    const bool wholly = isLed(island) || isOpened(island, tolerance);
    if (wholly || isFarOff(island, solved, tolerance)) {
      island.solution.lambda.clear();
      solved = solveFine(island, wholly ? fineTolerance(island) : tolerance);
      if (wholly) return solved;
    }
  }
  if (keepFromGaining(island, h))
    solved.residual = naturalResidual(island.problem, island.solution);
  return solved;
}

bool Stepping::isOpened(const Island& island, double tolerance) const {
  const Problem& problem = island.problem;
  const double most = tolerance * velocityScale(problem);
  return std::any_of(problem.cones.begin(), problem.cones.end(), [&](const Cone& cone) {
    return cone.kind == ConeKind::Equality &&
           std::abs(rowVelocity(problem.rows[cone.row], island.solution.v)) > most;
  });
}

double Stepping::leastRebound(const Touch& touch, double least) const {
  constexpr double kLeft = 2.0;  // ends of a contact
  for (const int i : {touch.contact.a, touch.contact.b})
    least = std::max(least, kLeft * memory_.left[i]);
  return least;
}

}  // namespace tumble
