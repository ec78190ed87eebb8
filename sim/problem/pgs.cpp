// Chapter 6, problem: projected Gauss–Seidel at velocity level.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/problem/anderson.h"
#include "sim/problem/cone.h"
#include "sim/problem/friction_block.h"
#include "sim/problem/solvers.h"

namespace tumble {
namespace {

constexpr int kAsk = 64;  ///< sweeps from one look at the residual to the next

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
  void begin(const Problem& problem, Solution& solution);
  void prepare(const Problem& problem);
  double sweep(const Problem& problem, bool forwards, Solution& solution);
  double relax(const Problem& problem, const SweepCone& cone, Solution& solution);
  void accelerate(const Problem& problem, Solution& solution);

  std::vector<SweepRow> rows_;
  std::vector<SweepCone> cones_;
  VecX before_, after_, best_, weight_;
  Anderson mixer_;
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
  weight_.setOnes(rows_.size());
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
      if (cone.W(i, i) > 0.0) weight_[cone.row + i] = cone.W(i, i);
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

/// Puts a mixture of this sweep and earlier ones in its place.
void Sweeper::accelerate(const Problem& problem, Solution& solution) {
  const Eigen::Index n = before_.size();
  after_ = VecX::Map(solution.lambda.data(), n);
  mixer_.next(before_, after_);
  VecX::Map(solution.lambda.data(), n) = before_;
  velocitiesFromLambda(problem, solution.lambda, solution.v);
}

/// Starts from λ = solution.lambda, or 0 if it is not of the right length.
void Sweeper::begin(const Problem& problem, Solution& solution) {
  if (solution.lambda.size() != problem.rows.size())
    solution.lambda.assign(problem.rows.size(), 0.0);
  solution.v.resize(problem.vStar.size());
  velocitiesFromLambda(problem, solution.lambda, solution.v);
}

SolveReport Sweeper::solve(const Problem& problem, const SolveSettings& settings,
                           Solution& solution) {
  // A start that is good enough is the answer.
  begin(problem, solution);
  SolveReport report{.residual = naturalResidual(problem, solution)};
  if (report.residual <= settings.tolerance) return report;

  prepare(problem);
  before_ = best_ = VecX::Map(solution.lambda.data(), solution.lambda.size());
  mixer_.reset(weight_);
  double bestChange = std::numeric_limits<double>::infinity();
  double target = settings.tolerance * velocityScale(problem);
  while (report.iterations < settings.maxIterations) {
    // There and back is a symmetric iteration.
    const double there = sweep(problem, true, solution);
    const double change = std::max(there, sweep(problem, false, solution));
    report.iterations += 2;
    if (change < bestChange) {
      bestChange = change;
      best_ = VecX::Map(solution.lambda.data(), best_.size());
    }
    // When the sweeps move hardly any more, and now and then before, the residual itself is asked.
    if (change <= target || report.iterations % kAsk == 0) {
      velocitiesFromLambda(problem, solution.lambda, solution.v);
      report.residual = naturalResidual(problem, solution);
      if (report.residual <= settings.tolerance || atRounding(problem, solution, report.residual))
        return report;
      if (change <= target) target *= 0.25;
    }
    accelerate(problem, solution);
  }
  VecX::Map(solution.lambda.data(), best_.size()) = best_;
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
