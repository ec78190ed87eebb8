// Chapter 6, problem: projected Gauss–Seidel at velocity level.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/problem/cone.h"
#include "sim/problem/friction_block.h"
#include "sim/problem/solvers.h"

namespace tumble {
namespace {

/// A row with what its λ does to the two bodies: the columns of M⁻¹ Jᵀ.
struct SweepRow {
  Vec6 Ja, Jb;        ///< u = Ja·va + Jb·vb + bias
  Vec6 pushA, pushB;  ///< dv/dλ
};

/// A cone ready to be swept.
struct SweepCone {
  ConeKind kind;
  int row, rows, a, b;
  double mu;
  double mobility;  ///< largest diagonal entry of W [1/kg]
  Mat3 W;           ///< block of J M⁻¹ Jᵀ
};

class Sweeper {
 public:
  SolveReport solve(const Problem& problem, const SolveSettings& settings, Solution& solution);

 private:
  void prepare(const Problem& problem);
  double sweep(const Problem& problem, bool forwards, Solution& solution);
  double relax(const Problem& problem, const SweepCone& cone, Solution& solution);
  void accelerate(Solution& solution);

  std::vector<SweepRow> rows_;
  std::vector<SweepCone> cones_;
  std::vector<double> lambdaBefore_, lambdaStep_;  // conjugate direction
  std::vector<Vec6> vBefore_, vStep_;
  double sizeBefore_ = 0.0;
};

void Sweeper::prepare(const Problem& problem) {
  rows_.resize(problem.rows.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& from = problem.rows[i];
    SweepRow& row = rows_[i];
    row.Ja << from.linear, from.angularA;
    row.Jb << -from.linear, from.angularB;
    row.pushA << problem.invM[from.a] * from.linear, problem.Iinv[from.a] * from.angularA;
    row.pushB << -problem.invM[from.b] * from.linear, problem.Iinv[from.b] * from.angularB;
  }
  cones_.resize(problem.cones.size());
  for (std::size_t c = 0; c < cones_.size(); ++c) {
    const Cone& from = problem.cones[c];
    const Row& first = problem.rows[from.row];
    SweepCone& cone = cones_[c];
    cone = {from.kind, from.row, coneRows(from.kind), first.a, first.b, from.mu, 0.0, Mat3::Zero()};
    for (int i = 0; i < cone.rows; ++i) {
      for (int j = 0; j < cone.rows; ++j) {
        const SweepRow &left = rows_[cone.row + i], &right = rows_[cone.row + j];
        cone.W(i, j) = left.Ja.dot(right.pushA) + left.Jb.dot(right.pushB);
      }
      cone.mobility = std::max(cone.mobility, cone.W(i, i));
    }
  }
}

/// λ of one cone from its own equations, all others kept. c: u without its λ.
Vec3 solveCone(const SweepCone& cone, const Vec3& c, const Vec3& old) {
  switch (cone.kind) {
    case ConeKind::Equality:
      return {-c[0] / cone.W(0, 0), 0.0, 0.0};
    case ConeKind::Push:
      return {std::max(-c[0] / cone.W(0, 0), 0.0), 0.0, 0.0};
    case ConeKind::Friction:
      return solveFrictionBlock(cone.W, c, cone.mu, old);
    case ConeKind::Slide:
      break;
  }
  const double mobility = cone.W(0, 0) - cone.mu * cone.W(0, 1);
  const double push = mobility > 0.0 ? std::max(-c[0] / mobility, 0.0) : 0.0;
  return {push, -cone.mu * push, 0.0};
}

/// Solves one cone and moves its bodies. Returns the largest change of λ in units of u.
double Sweeper::relax(const Problem& problem, const SweepCone& cone, Solution& solution) {
  if (cone.mobility <= 0.0) return 0.0;
  Vec6 &va = solution.v[cone.a], &vb = solution.v[cone.b];
  Vec3 u = Vec3::Zero(), old = Vec3::Zero();
  for (int k = 0; k < cone.rows; ++k) {
    const SweepRow& row = rows_[cone.row + k];
    u[k] = row.Ja.dot(va) + row.Jb.dot(vb) + problem.rows[cone.row + k].bias;
    old[k] = solution.lambda[cone.row + k];
  }
  const Vec3 free = u - cone.W * old;
  const Vec3 lambda = solveCone(cone, free, old);
  const Vec3 change = lambda - old;
  for (int k = 0; k < cone.rows; ++k) {
    const SweepRow& row = rows_[cone.row + k];
    solution.lambda[cone.row + k] = lambda[k];
    va += change[k] * row.pushA;
    vb += change[k] * row.pushB;
  }
  return change.lpNorm<Eigen::Infinity>() * cone.mobility;
}

double Sweeper::sweep(const Problem& problem, bool forwards, Solution& solution) {
  double largest = 0.0;
  const std::size_t n = cones_.size();
  for (std::size_t i = 0; i < n; ++i)
    largest = std::max(largest, relax(problem, cones_[forwards ? i : n - 1 - i], solution));
  return largest;
}

/// Fletcher–Reeves on λ, with the change of the last sweep as the gradient; v follows linearly.
void Sweeper::accelerate(Solution& solution) {
  double size = 0.0;
  for (std::size_t i = 0; i < lambdaBefore_.size(); ++i) {
    const double change = solution.lambda[i] - lambdaBefore_[i];
    size += change * change;
  }
  const bool restart = !(size < sizeBefore_);
  const double beta = restart ? 0.0 : size / sizeBefore_;
  sizeBefore_ = size;
  for (std::size_t i = 0; i < lambdaBefore_.size(); ++i) {
    const double change = solution.lambda[i] - lambdaBefore_[i];
    const double step = beta * lambdaStep_[i];
    solution.lambda[i] += step;
    lambdaStep_[i] = step + change;
    lambdaBefore_[i] = solution.lambda[i];
  }
  for (std::size_t i = 0; i < vBefore_.size(); ++i) {
    const Vec6 change = solution.v[i] - vBefore_[i];
    const Vec6 step = beta * vStep_[i];
    solution.v[i] += step;
    vStep_[i] = step + change;
    vBefore_[i] = solution.v[i];
  }
}

SolveReport Sweeper::solve(const Problem& problem, const SolveSettings& settings,
                           Solution& solution) {
  // A start that is good enough is the answer.
  if (solution.lambda.size() != problem.rows.size())
    solution.lambda.assign(problem.rows.size(), 0.0);
  solution.v.resize(problem.vStar.size());
  velocitiesFromLambda(problem, solution.lambda, solution.v);
  SolveReport report{.residual = naturalResidual(problem, solution)};
  if (report.residual <= settings.tolerance) return report;

  prepare(problem);
  lambdaBefore_ = solution.lambda;
  lambdaStep_.assign(solution.lambda.size(), 0.0);
  vBefore_ = solution.v;
  vStep_.assign(solution.v.size(), Vec6::Zero());
  sizeBefore_ = 0.0;

  const double scale = velocityScale(problem);
  double target = settings.tolerance * scale;
  int tries = 0;
  while (report.iterations < settings.maxIterations) {
    // Forwards and back is one symmetric sweep.
    const double change = std::max(sweep(problem, true, solution), sweep(problem, false, solution));
    report.iterations += 2;
    if (change <= target) {
      // The sweeps move hardly any more: ask the residual itself.
      velocitiesFromLambda(problem, solution.lambda, solution.v);
      report.residual = naturalResidual(problem, solution);
      if (report.residual <= settings.tolerance) return report;
      if (++tries > 8) break;
      target *= 0.25;
    }
    accelerate(solution);
  }
  velocitiesFromLambda(problem, solution.lambda, solution.v);
  report.residual = naturalResidual(problem, solution);
  if (!(report.residual <= 10.0 * settings.tolerance)) report.status = SolveStatus::NotConverged;
  return report;
}

}  // namespace

SolveReport solvePgs(const Problem& problem, const SolveSettings& settings, Solution& solution) {
  thread_local Sweeper sweeper;  // keeps its memory from call to call
  return sweeper.solve(problem, settings, solution);
}

}  // namespace tumble
