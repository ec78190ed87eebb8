#include "sim/problem/last_resort.h"

#include <algorithm>
#include <cmath>

#include "sim/problem/polish.h"
#include "sim/problem/solvers.h"

namespace tumble {
namespace {

constexpr std::size_t kDense = 120;  ///< rows up to which dense steps are tried
constexpr double kNear = 1e-8;       ///< residual below which they are not worth their price

/// The best answer so far.
struct Best {
  SolveReport report;
  Solution solution;

  bool solved() const { return report.status == SolveStatus::Solved; }

  /// What it took is for the caller to add.
  void take(SolveReport other, Solution&& candidate) {
    if (!std::isfinite(other.residual)) return;
    if (!(other.residual < report.residual || !std::isfinite(report.residual))) return;
    other.iterations = report.iterations;
    report = other;
    solution = std::move(candidate);
  }
};

/// The same forces, without what is not a number, and the velocities that they give.
Solution finite(const Problem& problem, const Solution& solution) {
  Solution start = solution;
  for (double& lambda : start.lambda)
    if (!std::isfinite(lambda)) lambda = 0.0;
  velocitiesFromLambda(problem, start.lambda, start.v);
  return start;
}

/// A path from an easy problem, t = 0, to the one that is asked for, t = 1: friction grows from
/// none, while contacts close that have more room at first.
class Path {
 public:
  /// @param room  [m/s] that contacts have at t = 0 beside their bias
  Path(const Problem& problem, double room) : asked_(problem), now_(problem), room_(room) {}

  /// Puts the end of the path, if that is reached, in place of the best answer if it is nearer.
  /// @param longest  step of t; the path is another where steps are shorter
  void follow(double longest, const SolveSettings& settings, const NewtonAlone& newton, Best& best);

 private:
  void set(double t);
  SolveReport step(const SolveSettings& settings, const NewtonAlone& newton, Solution& solution,
                   Best& best);

  const Problem& asked_;
  Problem now_;
  double room_;
};

void Path::set(double t) {
  for (std::size_t i = 0; i < now_.cones.size(); ++i) {
    Cone& cone = now_.cones[i];
    cone.mu = t * asked_.cones[i].mu;
    if (cone.kind != ConeKind::Equality)
      now_.rows[cone.row].bias = asked_.rows[cone.row].bias + (1.0 - t) * room_;
  }
}

/// Polishes what the problem before has led to; else starts anew and polishes that.
SolveReport Path::step(const SolveSettings& settings, const NewtonAlone& newton, Solution& solution,
                       Best& best) {
  const Solution start = solution;
  SolveReport report = polish(now_, settings, solution);
  best.report.iterations += report.iterations;
  if (report.status == SolveStatus::Solved) return report;
  solution = start;
  best.report.iterations += newton(now_, settings, solution).iterations;
  report = polish(now_, settings, solution);
  best.report.iterations += report.iterations;
  return report;
}

void Path::follow(double longest, const SolveSettings& settings, const NewtonAlone& newton,
                  Best& best) {
  constexpr int kSteps = 30, kFactors = 1000;
  constexpr double kGood = 1e-6;  // residual from which a step goes on
  const SolveSettings brief{settings.tolerance, std::min(kFactors, settings.maxIterations)};
  set(0.0);
  Solution solution;
  best.report.iterations += newton(now_, brief, solution).iterations;
  double t = 0.0, length = longest;
  for (int k = 0; k < kSteps; ++k) {
    const double next = std::min(1.0, t + length);
    set(next);
    Solution trial = solution;
    const SolveReport report = step(brief, newton, trial, best);
    if (!(report.residual <= kGood)) {
      length *= 0.5;
      continue;
    }
    solution = trial;
    if (next == 1.0) {
      best.take(report, std::move(trial));
      return;
    }
    t = next;
    length = std::min(longest, 2.0 * length);
  }
}

/// The fastest approach [m/s] of the contacts, if nothing acts.
double fastestApproach(const Problem& problem) {
  std::vector<double> u(problem.rows.size());
  rowVelocities(problem, problem.vStar, u);
  double fastest = 0.0;
  for (const Cone& cone : problem.cones)
    if (cone.kind != ConeKind::Equality) fastest = std::max(fastest, -u[cone.row]);
  return fastest;
}

/// Goes on from the best answer.
void sweep(const Problem& problem, int most, const SolveSettings& settings, Best& best) {
  constexpr int kOfFactor = 20;  // sweeps in the time of a factorization
  Solution swept = finite(problem, best.solution);
  most = std::min(most, settings.maxIterations);
  const SolveReport report = solvePgs(problem, {settings.tolerance, most}, swept);
  best.report.iterations += 1 + report.iterations / kOfFactor;
  best.take(report, std::move(swept));
}

/// As many sweeps as the time is worth that is spent already.
int sweepsAtLast(const Problem& problem, double residual) {
  constexpr int kFar = 100'000, kClose = 10'000;  // cones times sweeps
  constexpr int kLeast = 20, kMost = 4000;
  const int work = residual <= kNear ? kClose : kFar;
  return std::clamp(work / static_cast<int>(problem.cones.size()), kLeast, kMost);
}

/// Whether joints hold bodies of the problem.
bool isJoined(const Problem& problem) {
  return std::any_of(problem.cones.begin(), problem.cones.end(), [&](const Cone& cone) {
    return cone.kind == ConeKind::Equality && problem.rows[cone.row].compliance == 0.0;
  });
}

}  // namespace

SolveReport lastResort(const Problem& problem, const SolveSettings& settings,
                       const NewtonAlone& newton, const SolveReport& report, Solution& solution) {
  constexpr int kFewSweeps = 100;  // those that come to an end mostly do so in fewer
  Best best{report, solution};
  const auto asksDense = [&] {
    return problem.rows.size() <= kDense && !(best.report.residual <= kNear);
  };
  if (asksDense() && isJoined(problem)) sweep(problem, kFewSweeps, settings, best);
  if (asksDense() && !best.solved()) {
    Solution polished = finite(problem, solution);
    const SolveReport last = polish(problem, settings, polished);
    best.report.iterations += last.iterations;
    best.take(last, std::move(polished));
    const double rooms[] = {0.0, fastestApproach(problem)};
    for (const double longest : {0.5, 0.15})
      for (const double room : rooms)
        if (!best.solved()) Path(problem, room).follow(longest, settings, newton, best);
  }
  if (!best.solved()) sweep(problem, sweepsAtLast(problem, best.report.residual), settings, best);
  solution = best.solution;
  return best.report;
}

}  // namespace tumble
