// Chapter 6, problem: projected Gauss–Seidel at velocity level. Its blocks are contacts, and all
// that is held by equalities: a chain that is swept link by link takes as many sweeps as the square
// of its links, and more by what hangs on it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/problem/anderson.h"
#include "sim/problem/equalities.h"
#include "sim/problem/solvers.h"
#include "sim/problem/sweep.h"

namespace tumble {
namespace {

constexpr int kRounded = 4;  ///< looks at a residual that is rounding
constexpr int kAsk = 64;     ///< sweeps from one look at the residual to the next

class Sweeper {
 public:
  SolveReport solve(const Problem& problem, const SolveSettings& settings, Solution& solution);

 private:
  void begin(const Problem& problem, Solution& solution);
  double ask(const Problem& problem, const VecX& lambda, Solution& solution,
             double most = std::numeric_limits<double>::infinity()) const;
  bool spent(double residual, bool stands);
  bool findEqualities(const Problem& problem, double dependent);
  double thereAndBack(const Problem& problem);
  void accelerate();

  ConeSweeps sweep_;
  Equalities equalities_;
  bool holds_ = false;  ///< they are a block
  VecX lambda_, before_, best_, rounded_;
  double leastChange_ = 0.0, leastRounded_ = 0.0;
  int timesRounded_ = 0;
  double scale_ = 1.0;  ///< [m/s] velocityScale
  Anderson mixer_;
};

/// Starts from λ = solution.lambda, or 0 if it is not of the right length.
void Sweeper::begin(const Problem& problem, Solution& solution) {
  if (solution.lambda.size() != problem.rows.size())
    solution.lambda.assign(problem.rows.size(), 0.0);
  solution.v.resize(problem.vStar.size());
  lambda_ = VecX::Map(solution.lambda.data(), solution.lambda.size());
  scale_ = velocityScale(problem);
}

/// Writes λ with its velocities, and asks for their residual; above `most`, for a part of it.
double Sweeper::ask(const Problem& problem, const VecX& lambda, Solution& solution,
                    double most) const {
  VecX::Map(solution.lambda.data(), lambda.size()) = lambda;
  velocitiesFromLambda(problem, solution.lambda, solution.v);
  return naturalResidual(problem, solution, scale_, most);
}

/// Keeps the best of the answers whose residual is rounding. Whether it is the last: if the
/// residual stands, or has been rounding for some time.
bool Sweeper::spent(double residual, bool stands) {
  if (timesRounded_++ == 0 || residual < leastRounded_) {
    leastRounded_ = residual;
    rounded_ = lambda_;
  }
  return stands || timesRounded_ == kRounded;
}

/// Whether equalities are a block: more than one row, and fewer than cost more than the sweeps;
/// none that yields, as sweeps suit those.
bool Sweeper::findEqualities(const Problem& problem, double dependent) {
  constexpr int kMost = 300;  // rows
  int rows = 0;
  for (const Cone& cone : problem.cones) {
    if (cone.kind != ConeKind::Equality) continue;
    if (problem.rows[cone.row].compliance > 0.0) return false;
    ++rows;
  }
  return rows > 1 && rows <= kMost && equalities_.factorRegular(problem, dependent);
}

/// A sweep there and one back: a symmetric iteration. Returns the largest change.
double Sweeper::thereAndBack(const Problem& problem) {
  const double there = sweep_.pass(true, lambda_);
  const double change = std::max(there, sweep_.pass(false, lambda_));
  if (holds_) {
    equalities_.solve(problem, {lambda_.data(), static_cast<std::size_t>(lambda_.size())});
    sweep_.take(lambda_);
  }
  return change;
}

/// Puts a mixture of these sweeps and earlier ones in their place.
void Sweeper::accelerate() {
  mixer_.next(before_, lambda_);
  sweep_.take(lambda_);
}

SolveReport Sweeper::solve(const Problem& problem, const SolveSettings& settings,
                           Solution& solution) {
  // A start that is good enough is the answer.
  begin(problem, solution);
  SolveReport report{.residual = ask(problem, lambda_, solution, settings.tolerance),
                     .scale = scale_};
  if (report.residual <= settings.tolerance) return report;

  sweep_.prepare(problem);
  holds_ = findEqualities(problem, std::max(settings.dependent, LeastSquares::kDependent));
  sweep_.take(lambda_);
  before_ = best_ = lambda_;
  mixer_.reset(sweep_.mobility());
  leastChange_ = std::numeric_limits<double>::infinity();
  double target = settings.tolerance * scale_;
  timesRounded_ = 0;
  while (report.iterations < settings.maxIterations) {
    const double change = thereAndBack(problem);
    report.iterations += 2;
    if (!std::isfinite(lambda_.sum())) break;  // what has no answer is pushed harder for ever
    if (change < leastChange_) {
      leastChange_ = change;
      best_ = lambda_;
    }
    // When the sweeps move hardly any more, and now and then before, the residual itself is asked.
    if (change <= target || report.iterations % kAsk == 0) {
      const double before = report.residual;
      report.residual = ask(problem, lambda_, solution);
      if (report.residual <= settings.tolerance) return report;
      const bool stands = change <= target || report.residual > 0.5 * before;
      if (atRounding(problem, solution, report.residual) && spent(report.residual, stands)) {
        report.residual = ask(problem, rounded_, solution);
        return report;
      }
      if (change <= target) target *= 0.25;
    }
    if (report.iterations < settings.maxIterations) accelerate();
  }
  report.residual = ask(problem, best_, solution);
  if (!(report.residual <= settings.tolerance)) report.status = SolveStatus::NotConverged;
  return report;
}

}  // namespace

SolveReport solvePgs(const Problem& problem, const SolveSettings& settings, Solution& solution) {
  thread_local Sweeper sweeper;  // keeps its memory from call to call
  return sweeper.solve(problem, settings, solution);
}

}  // namespace tumble
