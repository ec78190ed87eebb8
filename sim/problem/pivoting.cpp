// Chapter 6, problem: Dantzig pivoting on a whole problem.
#include <limits>

#include "sim/problem/cone.h"
#include "sim/problem/delassus.h"
#include "sim/problem/lcp.h"
#include "sim/problem/solvers.h"

namespace tumble {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kPasses = 100;
constexpr int kPolishSweeps = 2000;

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

}  // namespace

SolveReport solvePivoting(const Problem& problem, const SolveSettings& settings,
                          Solution& solution) {
  const Delassus system = delassus(problem);
  const int n = static_cast<int>(problem.rows.size());
  VecX lambda = VecX::Zero(n), lo = VecX::Zero(n), hi = VecX::Zero(n);
  solution.v.resize(problem.vStar.size());
  SolveReport report;
  Solution best;
  double bestResidual = kInfinity;
  for (int pass = 0; pass < kPasses; ++pass) {
    const bool friction = setBounds(problem, lambda, lo, hi);
    const LcpReport lcp = solveLcp(system.A, system.b, lo, hi, lambda);
    report.iterations += lcp.pivots;
    report.status = lcp.status;
    solution.lambda.assign(lambda.data(), lambda.data() + n);
    velocitiesFromLambda(problem, solution.lambda, solution.v);
    report.residual = naturalResidual(problem, solution);
    if (report.residual < bestResidual) {
      bestResidual = report.residual;
      best = solution;
    }
    if (!friction || report.residual <= settings.tolerance) return report;
    if (lcp.status == SolveStatus::Infeasible) break;
  }
  // What the pyramid leaves to the cone is done by sweeps.
  solution = best;
  const int pivots = report.iterations;
  report = solvePgs(problem, {settings.tolerance, kPolishSweeps}, solution);
  report.iterations += pivots;
  return report;
}

}  // namespace tumble
