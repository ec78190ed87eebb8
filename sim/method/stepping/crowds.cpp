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

namespace tumble {
namespace {

constexpr std::size_t kSmall = 128;  ///< contacts that cost little to be solved to the end

}  // namespace

int Stepping::weightOf(const PairMemory& pair) {
  return weightOfContacts(static_cast<int>(pair.touches.size()),
                          pair.touches.front().contact.friction);
}

bool Stepping::isCrowd(std::span<const Link> links) const {
  int weight = 0;
  bool bounces = model_.def.stepping.anyCrowd;
  for (const Link link : links) {
    if (!isPair(link) || memory_.pairs[link].touches.empty()) continue;
    bounces = bounces || memory_.pairs[link].bounces;
    weight += weightOf(memory_.pairs[link]);
  }
  return bounces && weight > kReflectionsReach;
}

bool Stepping::isCrowd() const {
  int weight = 0;
  bool bounces = false;
  for (const PairMemory& pair : memory_.pairs) {
    if (pair.touches.empty()) continue;
    bounces = bounces || pair.bounces;
    weight += weightOf(pair);
  }
  return (bounces || model_.def.stepping.anyCrowd) && weight > kReflectionsReach;
}

bool Stepping::strikesAsCrowd() const {
  return crowd_ && (model_.def.impact == "auto" || model_.def.impact == "crowd");
}

bool Stepping::isManyContacts(std::span<const Link> links) const {
  constexpr std::size_t kFew = 16;  // contacts that are solved as well as others
  return work_.problem.cones.size() > kFew && !isBonded(links);
}

double Stepping::roughTolerance(std::span<const Link> links, double scale) const {
  constexpr double kMoves = 3e-3;  // of the largest speed
  const SteppingSettings& stepping = model_.def.stepping;
  const Problem& problem = work_.problem;
  if (!isManyContacts(links) ||
      (stepping.crowdSolver == stepping.solver && stepping.crowdTolerance == stepping.tolerance))
    return 0.0;
  double fastest = 0.0;
  for (const Row& row : problem.rows)
    fastest = std::max(fastest,
                       std::abs(rowSpeed(row, work_.solution.v[row.a], work_.solution.v[row.b])));
  if (fastest <= kMoves * scale) return 0.0;
  return std::max(stepping.tolerance, stepping.crowdTolerance * std::min(1.0, fastest / scale));
}

void Stepping::takeBack(std::span<const Link> links) {
  for (const Link link : links)
    if (isPair(link))
      for (Touch& touch : memory_.pairs[link].touches) touch.due = std::max(touch.due, 0.0);
}

void Stepping::setAside(std::span<const Link> links, double scale, double h) {
  constexpr double kFar = 0.1, kAside = -1.0;  // of the scale: few that part so fast are pushed
  if (!again_ || !isHasty()) takeBack(links);
  if (!isHasty()) return;
  Problem& problem = work_.problem;
  std::size_t cone = 0, kept = 0;
  int rows = 0;
  for (const Link link : links) {
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
  work_.pull.clear();
}

void Stepping::startFromBefore(std::span<const Link> links, double h) {
  work_.solution.lambda.assign(work_.problem.rows.size(), 0.0);
  std::size_t cone = 0;
  for (const Link link : links) {
    if (!isPair(link)) {
      ++cone;
      continue;
    }
    for (const Touch& touch : memory_.pairs[link].touches) {
      if (flies(touch, h) || isAside(touch)) continue;
      const Cone& of = work_.problem.cones[cone++];
      const double longer = touch.length > 0.0 ? h / touch.length : 0.0;
      for (int r = of.row; r < of.row + coneRows(of.kind); ++r)
        work_.solution.lambda[r] = longer * touch.impulse.dot(work_.problem.rows[r].linear);
    }
  }
}

/// The energy of bodies that go through a step with v = vBefore + h M⁻¹F + s Δ, Δ = M⁻¹ Jᵀ λ,
/// changes by  −½ |h M⁻¹F|²_M + s λ·J vBefore + ½ s² λ·J Δ,  without the work of supports: J v is
/// relative.
bool Stepping::keepFromGaining(double h) {
  Solution& solution = work_.solution;
  const Problem& problem = work_.problem;
  double slope = 0.0, curvature = 0.0, fall = 0.0;
  const auto before = [&](int local) -> const Vec6& { return work_.before[work_.bodies[local]]; };
  for (const Cone& cone : problem.cones) {
    for (int r = cone.row; r < cone.row + coneRows(cone.kind); ++r) {
      const Row& row = problem.rows[r];
      const double star = rowSpeed(row, problem.vStar[row.a], problem.vStar[row.b]);
      slope += solution.lambda[r] * rowSpeed(row, before(row.a), before(row.b));
      curvature +=
          solution.lambda[r] * (rowSpeed(row, solution.v[row.a], solution.v[row.b]) - star);
    }
  }
  for (std::size_t i = 0; i < work_.bodies.size(); ++i) {
    const RigidBody& body = state_.bodies[work_.bodies[i]];
    if (body.fixed() || solution.v[i] == problem.vStar[i]) continue;
    fall += 0.5 * h * h *
            (body.invM * body.force.squaredNorm() + body.torque.dot(body.Iinv * body.torque));
  }
  if (slope + 0.5 * curvature <= fall) return false;
  const double part =
      std::clamp((std::sqrt(slope * slope + 2.0 * curvature * fall) - slope) / curvature, 0.0, 1.0);
  for (double& lambda : solution.lambda) lambda *= part;
  velocitiesFromLambda(problem, solution.lambda, solution.v);
  return true;
}

void Stepping::leaveOpen(double scale, double h) {
  const SteppingSettings& stepping = model_.def.stepping;
  leftOpen_ = std::max(leftOpen_, stepping.crowdOpen * h * scale * stepping.crowdTolerance);
}

bool Stepping::isFarOff(const SolveReport& solved, double tolerance) const {
  constexpr int kMeant = 100;      // sweeps: a plan of fewer takes what they leave
  constexpr double kFarOff = 5.0;  // times the tolerance
  return model_.def.stepping.crowdIterations >= kMeant && work_.problem.cones.size() <= kSmall &&
         solved.residual > kFarOff * tolerance;
}

SolveReport Stepping::solveAsPlanned(std::span<const Link> links, bool bent, bool crowd,
                                     IslandMemory& memory, double h) {
  const double scale = !bent && crowd ? velocityScale(work_.problem) : 0.0;
  const double part = scale > 0.0 ? roughTolerance(links, scale) : 0.0;
  memory.rough = part > 0.0;
  if (memory.rough) {
    setAside(links, scale, h);
    return solveRough(links, part, h);
  }
  takeBack(links);
  if (scale > 0.0 && isDrafted() && isManyContacts(links) && work_.problem.cones.size() > kSmall)
    return solveCalm(links, memory, h);
  if (bent) startFromBefore(links, h);
  SolveReport solved = solveFine(links);
  if (reboundsInStep() && anyRebounds(links) && keepFromGaining(h))
    solved.residual = naturalResidual(work_.problem, work_.solution);
  return solved;
}

bool Stepping::anyRebounds(std::span<const Link> links) const {
  return std::any_of(links.begin(), links.end(), [&](Link link) {
    return isPair(link) &&
           std::any_of(memory_.pairs[link].touches.begin(), memory_.pairs[link].touches.end(),
                       [](const Touch& touch) { return touch.rebounds; });
  });
}

SolveReport Stepping::solveCalm(std::span<const Link> links, IslandMemory& memory, double h) {
  constexpr int kFewIterations = 20, kSteps = 8;
  if (step_ >= memory.sweptTo) {
    startFromBefore(links, h);
    const SolveReport solved =
        solver_.solve(work_.problem,
                      {.tolerance = model_.def.stepping.tolerance, .maxIterations = kFewIterations},
                      work_.solution);
    if (solved.status == SolveStatus::Solved) return solved;
    memory.sweptTo = step_ + kSteps;
  }
  memory.rough = true;
  return solveRough(links, model_.def.stepping.crowdTolerance, h);
}

/// What is left open is a velocity: that of a point of cloth is soon small, while the push behind
/// it still moves the heavy body that lies on it.
double Stepping::lightness() const {
  double heaviest = 0.0, lightest = std::numeric_limits<double>::infinity();
  for (const int i : work_.movers) {
    const double mass = state_.bodies[i].M;
    if (model_.bends(i))
      lightest = std::min(lightest, mass);
    else
      heaviest = std::max(heaviest, mass);
  }
  return std::min(1.0, heaviest > 0.0 ? lightest / heaviest : 1.0);
}

SolveReport Stepping::solveFine(std::span<const Link> links) {
  constexpr double kReach = 1e-12;  // what solvers reach
  const SteppingSettings& stepping = model_.def.stepping;
  const double tolerance =
      std::min(stepping.tolerance, std::max(kReach, stepping.tolerance * lightness()));
  const SolveReport solved = solver_.solve(
      work_.problem,
      {.tolerance = tolerance, .maxIterations = stepping.iterations, .pull = work_.pull},
      work_.solution);
  findCrushed(links, solved);
  if (solved.status != SolveStatus::Solved)
    report_.note("some steps were left above the tolerance; max_complementarity has the worst");
  return solved;
}

SolveReport Stepping::solveRough(std::span<const Link> links, double tolerance, double h) {
  const SteppingSettings& stepping = model_.def.stepping;
  startFromBefore(links, h);
  SolveReport solved =
      findSolver(stepping.crowdSolver)
          ->solve(work_.problem,
                  {.tolerance = tolerance, .maxIterations = stepping.crowdIterations},
                  work_.solution);
  if (solved.status != SolveStatus::Solved && (isLed(links) || isFarOff(solved, tolerance))) {
    work_.solution.lambda.clear();
    return solveFine(links);
  }
  if (keepFromGaining(h))
    solved.residual = naturalResidual(work_.problem, work_.solution, solved.scale);
  return solved;
}

double Stepping::leastRebound(const Touch& touch, double least) const {
  constexpr double kLeft = 2.0;  // ends of a contact
  for (const int i : {touch.contact.a, touch.contact.b})
    if (i < static_cast<int>(memory_.left.size())) least = std::max(least, kLeft * memory_.left[i]);
  return least;
}

}  // namespace tumble
