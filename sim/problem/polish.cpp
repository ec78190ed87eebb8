#include "sim/problem/polish.h"

#include <algorithm>
#include <cmath>

#include "sim/math/least_squares.h"
#include "sim/problem/cone.h"
#include "sim/problem/delassus.h"

namespace tumble {
namespace {

constexpr int kPasses = 40;
/// Passes without gain after which modes only go round in circles.
constexpr int kPatience = 8;

/// One pass: the equations G(λ) in units of u, and their derivative.
class Pass {
 public:
  Pass(const Problem& problem, const Delassus& system, const VecX& lambda)
      : system_(system), lambda_(lambda), u_(system.A * lambda + system.b), G(u_), dG(system.A) {
    for (const Cone& cone : problem.cones) {
      if (cone.kind == ConeKind::Equality) continue;
      const int i = cone.row, rows = coneRows(cone.kind);
      weight_ = 0.0;
      for (int k = 0; k < rows; ++k) weight_ = std::max(weight_, system.A(i + k, i + k));
      if (!(lambda[i] * weight_ > u_[i])) {
        for (int k = 0; k < rows; ++k) unload(i + k);
      } else if (cone.kind == ConeKind::Slide) {
        unload(i + 1);
        G[i + 1] += weight_ * cone.mu * lambda[i];
        dG(i + 1, i) = weight_ * cone.mu;
      } else if (cone.kind == ConeKind::Friction) {
        rub(i, cone.mu);
      }
    }
  }

 private:
  const Delassus& system_;
  const VecX& lambda_;
  VecX u_;
  double weight_ = 0.0;  ///< 1/ρ

 public:
  VecX G;
  MatX dG;

 private:
  /// λ = 0.
  void unload(int row) {
    G[row] = weight_ * lambda_[row];
    dG.row(row).setZero();
    dG(row, row) = weight_;
  }

  /// Stuck rows are u = 0 and stay as they are; λt = mu λn τ/|τ|, τ = λt − ρ ut, beyond the cone.
  void rub(int i, double mu) {
    const Eigen::Vector2d force = lambda_.segment<2>(i + 1);
    const Eigen::Vector2d tau = force - u_.segment<2>(i + 1) / weight_;
    const double length = tau.norm(), limit = mu * std::max(0.0, lambda_[i]);
    if (length <= limit) return;
    const Eigen::Vector2d d = tau / length;
    G.segment<2>(i + 1) = weight_ * (force - limit * d);
    const Eigen::Matrix2d turn =
        (limit / length) * (Eigen::Matrix2d::Identity() - d * d.transpose());
    MatX rows = turn * system_.A.middleRows<2>(i + 1);
    rows.middleCols<2>(i + 1) += weight_ * (Eigen::Matrix2d::Identity() - turn);
    rows.col(i) -= weight_ * mu * d;
    dG.middleRows<2>(i + 1) = rows;
  }
};

}  // namespace

SolveReport polish(const Problem& problem, const SolveSettings& settings, Solution& solution) {
  const Delassus system = delassus(problem);
  VecX lambda = Eigen::Map<const VecX>(solution.lambda.data(),
                                       static_cast<Eigen::Index>(solution.lambda.size()));
  SolveReport best{SolveStatus::NotConverged, naturalResidual(problem, solution), 0};
  Solution trial = solution;
  int since = 0;
  for (int pass = 0; pass < kPasses && since < kPatience; ++pass, ++since) {
    ++best.iterations;
    const Pass here(problem, system, lambda);
    lambda -= leastSquares(here.dG, here.G);
    if (!lambda.allFinite()) break;
    trial.lambda.assign(lambda.data(), lambda.data() + lambda.size());
    velocitiesFromLambda(problem, trial.lambda, trial.v);
    const double residual = naturalResidual(problem, trial);
    if (!(residual < best.residual)) continue;
    if (residual < 0.5 * best.residual) since = 0;
    best.residual = residual;
    solution = trial;
  }
  if (best.residual <= settings.tolerance || atRounding(problem, solution, best.residual))
    best.status = SolveStatus::Solved;
  return best;
}

}  // namespace tumble
