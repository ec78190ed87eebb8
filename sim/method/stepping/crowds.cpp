// Crowds: near bodies that more contacts join than reflections are for. They are struck once a
// step, for all that meets within it; what would rebound for less than a step lasts. Islands of
// many contacts that move are solved as far as is planned for them.
#include <algorithm>
#include <cmath>

#include "sim/contact/impact.h"
#include "sim/method/stepping/stepping.h"
#include "sim/problem/cone.h"

namespace tumble {

int Stepping::weightOf(const PairMemory& pair) {
  return weightOfContacts(static_cast<int>(pair.touches.size()),
                          pair.touches.front().contact.friction);
}

bool Stepping::isCrowd() const {
  int weight = 0;
  bool bounces = false;
  for (const PairMemory& pair : memory_.pairs) {
    if (pair.touches.empty()) continue;
    bounces = bounces || pair.bounces;
    weight += weightOf(pair);
  }
  return bounces && weight > kReflectionsReach;
}

bool Stepping::strikesAsCrowd() const {
  return crowd_ && (model_.def.impact == "auto" || model_.def.impact == "crowd");
}

bool Stepping::isRough() const {
  constexpr double kMoves = 3.0;    // times what the solver may leave
  constexpr std::size_t kFew = 16;  // contacts that are solved as well as others
  const SteppingSettings& stepping = model_.def.stepping;
  const Problem& problem = work_.problem;
  if (!crowd_ || !work_.bonds.empty() || problem.cones.size() <= kFew ||
      (stepping.crowdSolver == stepping.solver && stepping.crowdTolerance == stepping.tolerance))
    return false;
  const double still = kMoves * stepping.crowdTolerance * velocityScale(problem);
  return std::any_of(problem.rows.begin(), problem.rows.end(), [&](const Row& row) {
    return std::abs(rowSpeed(row, work_.solution.v[row.a], work_.solution.v[row.b])) > still;
  });
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
      if (flies(touch, h)) continue;
      const Cone& of = work_.problem.cones[cone++];
      const double longer = touch.length > 0.0 ? h / touch.length : 0.0;
      for (int r = of.row; r < of.row + coneRows(of.kind); ++r)
        work_.solution.lambda[r] = longer * touch.impulse.dot(work_.problem.rows[r].linear);
    }
  }
}

void Stepping::keepFromGaining() {
  Solution& solution = work_.solution;
  const Problem& problem = work_.problem;
  double slope = 0.0, curvature = 0.0;  // of the energy along λ, without the work of supports
  for (const Cone& cone : problem.cones) {
    if (cone.kind == ConeKind::Equality) return;
    for (int r = cone.row; r < cone.row + coneRows(cone.kind); ++r) {
      const Row& row = problem.rows[r];
      const double before = rowSpeed(row, problem.vStar[row.a], problem.vStar[row.b]);
      const double after = rowSpeed(row, solution.v[row.a], solution.v[row.b]);
      slope += solution.lambda[r] * before;
      curvature += solution.lambda[r] * (after - before);
    }
  }
  if (slope + 0.5 * curvature <= 0.0) return;
  const double part = std::clamp(-slope / curvature, 0.0, 1.0);
  for (double& lambda : solution.lambda) lambda *= part;
  velocitiesFromLambda(problem, solution.lambda, solution.v);
}

void Stepping::leaveOpen(double scale, double h) {
  constexpr double kOpen = 0.1;  // of what the solver may leave
  leftOpen_ = std::max(leftOpen_, kOpen * h * scale * model_.def.stepping.crowdTolerance);
}

SolveReport Stepping::solveRough(std::span<const Link> links, double h) {
  const SteppingSettings& stepping = model_.def.stepping;
  startFromBefore(links, h);
  const double scale = velocityScale(work_.problem);
  SolveReport solved =
      findSolver(stepping.crowdSolver)
          ->solve(work_.problem,
                  {.tolerance = stepping.crowdTolerance, .maxIterations = stepping.crowdIterations},
                  work_.solution);
  if (solved.status != SolveStatus::Solved && isLed(links)) {
    work_.solution.lambda.clear();
    return solveFine(links);
  }
  keepFromGaining();
  solved.residual = naturalResidual(work_.problem, work_.solution, scale);
  solved.scale = scale;
  return solved;
}

double Stepping::leastRebound(const Touch& touch, double least) const {
  constexpr double kLeft = 2.0;  // ends of a contact
  for (const int i : {touch.contact.a, touch.contact.b})
    if (i < static_cast<int>(memory_.left.size())) least = std::max(least, kLeft * memory_.left[i]);
  return least;
}

}  // namespace tumble
