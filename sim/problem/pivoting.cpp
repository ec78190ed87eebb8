// Chapter 6, problem: Dantzig pivoting on a whole problem.
#include <algorithm>
#include <limits>

#include "sim/problem/cone.h"
#include "sim/problem/delassus.h"
#include "sim/problem/direct.h"
#include "sim/problem/lcp.h"
#include "sim/problem/solvers.h"

namespace tumble {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kPasses = 100;
constexpr int kPolishSweeps = 2000;
constexpr int kPatience = 3;  ///< passes without gain after which the pyramid has told all it knows
constexpr double kExcuse = 1e-6;  ///< the largest residual that rounding, growing with λ, excuses
constexpr double kGain = 0.9;     ///< a gain: the residual falls below this part of the best before

/// Bounds of every row, given the normal λ of the pass before. Returns whether they depend on it.
bool setBounds(const Problem& problem, const VecX& lambda, VecX& lo, VecX& hi) {
  bool friction = false;
  for (const Cone& cone : problem.cones) {
    const int i = cone.row;
    lo[i] = cone.kind == ConeKind::Equality ? -kInfinity : 0.0;
    hi[i] = kInfinity;
    const double limit = cone.mu * lambda[i];
    if (cone.kind == ConeKind::Slide) lo[i + 1] = hi[i + 1] = -limit;
    if (cone.kind == ConeKind::Friction) {
      lo[i + 1] = lo[i + 2] = -limit;
      hi[i + 1] = hi[i + 2] = limit;
    }
    friction |= coneRows(cone.kind) > 1;
  }
  return friction;
}

bool allEqualities(const Problem& problem) {
  return std::all_of(problem.cones.begin(), problem.cones.end(),
                     [](const Cone& cone) { return cone.kind == ConeKind::Equality; });
}

/// λ and v of the whole problem from the λ of an LCP, and how good they are.
SolveReport look(const Problem& problem, const VecX& lambda, const LcpReport& lcp, double tolerance,
                 Solution& solution) {
  solution.lambda.assign(lambda.data(), lambda.data() + lambda.size());
  velocitiesFromLambda(problem, solution.lambda, solution.v);
  SolveReport report{lcp.status, naturalResidual(problem, solution), lcp.pivots};
  // Rows that repeat each other may contradict each other by what rounding left in them.
  if (report.residual <= tolerance) report.status = SolveStatus::Solved;
  return report;
}

}  // namespace

SolveReport solvePivoting(const Problem& problem, const SolveSettings& settings,
                          Solution& solution) {
  // Rows without bounds need no pivots.
  if (allEqualities(problem))
    if (const auto direct = solveDirect(problem, settings, solution)) return *direct;
  const Delassus system = delassus(problem);
  VecX lambda = VecX::Zero(system.b.size()), lo = lambda, hi = lambda;
  Solution best;
  double bestResidual = kInfinity;
  int pivots = 0, sinceBest = 0;
  solution.v.resize(problem.vStar.size());
  for (int pass = 0; pass < kPasses && sinceBest < kPatience; ++pass) {
    const bool friction = setBounds(problem, lambda, lo, hi);
    const LcpReport lcp = solveLcp(system.A, system.b, lo, hi, lambda);
    SolveReport report = look(problem, lambda, lcp, settings.tolerance, solution);
    report.iterations = pivots += lcp.pivots;
    const bool endless = lcp.status == SolveStatus::Infeasible;
    const bool rounded =
        !endless && report.residual <= kExcuse && atRounding(problem, solution, report.residual);
    if (report.residual <= settings.tolerance || rounded) {
      report.status = SolveStatus::Solved;
      return report;
    }
    if (endless) return report;
    ++sinceBest;
    if (report.residual < kGain * bestResidual) sinceBest = 0;
    if (report.residual < bestResidual) {
      bestResidual = report.residual;
      best = solution;
    }
    if (!friction) break;
  }

  // What the pyramid leaves to the cone, and the pivots to rounding, is done by sweeps.
  solution = best;
  SolveReport report = solvePgs(problem, {settings.tolerance, kPolishSweeps}, solution);
  report.iterations += pivots;
  if (report.residual > std::max(settings.tolerance, kExcuse))
    report.status = SolveStatus::NotConverged;
  return report;
}

}  // namespace tumble
