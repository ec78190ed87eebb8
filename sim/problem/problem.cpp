#include "sim/problem/problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/problem/cone.h"
#include "sim/problem/row.h"

namespace tumble {

void rowVelocities(const Problem& problem, std::span<const Vec6> v, std::span<double> u) {
  for (std::size_t i = 0; i < problem.rows.size(); ++i) u[i] = rowVelocity(problem.rows[i], v);
}

[[gnu::flatten]] void velocitiesFromLambda(const Problem& problem, std::span<const double> lambda,
                                           std::span<Vec6> v) {
  // First the impulses on each body, then the velocities they give.
  for (Vec6& twist : v) twist.setZero();
  for (std::size_t i = 0; i < problem.rows.size(); ++i) {
    const Row& row = problem.rows[i];
    v[row.a].head<3>() += lambda[i] * row.linear;
    v[row.b].head<3>() -= lambda[i] * row.linear;
    v[row.a].tail<3>() += lambda[i] * row.angularA;
    v[row.b].tail<3>() += lambda[i] * row.angularB;
  }
  for (std::size_t body = 0; body < v.size(); ++body) {
    const Vec3 angular = problem.Iinv[body] * v[body].tail<3>();
    v[body].head<3>() = problem.vStar[body].head<3>() + problem.invM[body] * v[body].head<3>();
    v[body].tail<3>() = problem.vStar[body].tail<3>() + angular;
  }
}

[[gnu::flatten]] double velocityScale(const Problem& problem) {
  double largest = 0.0, terms = 0.0;
  for (const Row& row : problem.rows) {
    largest = std::max(largest, std::abs(rowVelocity(row, problem.vStar)));
    terms = std::max(terms, termsOf(row, problem.vStar));
  }
  return velocityScale(largest, terms);
}

double naturalResidual(const Problem& problem, const Solution& solution) {
  return naturalResidual(problem, solution, velocityScale(problem));
}

[[gnu::flatten]] double naturalResidual(const Problem& problem, const Solution& solution,
                                        double scale, double most) {
  double worst = 0.0;
  for (const Cone& cone : problem.cones) {
    if (worst > most * scale) break;
    double u[3] = {}, mobility = 0.0;
    for (int k = 0; k < coneRows(cone.kind); ++k) {
      const Row& row = problem.rows[cone.row + k];
      u[k] = rowVelocity(row, solution.v) + row.compliance * solution.lambda[cone.row + k];
      mobility = std::max(mobility, rowMobility(problem, row));
    }
    const double rho = mobility > 0.0 ? 1.0 / mobility : 1.0;
    const double residual = coneResidual(cone, &solution.lambda[cone.row], u, rho);
    if (std::isnan(residual)) return residual;  // max would drop it
    worst = std::max(worst, residual);
  }
  return worst / scale;
}

double roundingFloor(const Problem& problem, const Solution& solution) {
  // The sums of rowVelocities and velocitiesFromLambda with every term made positive.
  thread_local std::vector<Vec6> v;  // keeps its storage from call to call
  v.assign(problem.vStar.size(), Vec6::Zero());
  for (std::size_t i = 0; i < problem.rows.size(); ++i) {
    const Row& row = problem.rows[i];
    const double size = std::abs(solution.lambda[i]);
    v[row.a].head<3>() += size * row.linear.cwiseAbs();
    v[row.b].head<3>() += size * row.linear.cwiseAbs();
    v[row.a].tail<3>() += size * row.angularA.cwiseAbs();
    v[row.b].tail<3>() += size * row.angularB.cwiseAbs();
  }
  for (std::size_t body = 0; body < v.size(); ++body) {
    const Vec3 angular = problem.Iinv[body].cwiseAbs() * v[body].tail<3>();
    v[body].head<3>() *= problem.invM[body];
    v[body].tail<3>() = angular;
    v[body] += problem.vStar[body].cwiseAbs();
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < problem.rows.size(); ++i) {
    const Row& row = problem.rows[i];
    largest = std::max(largest, termsOf(row, v) + row.compliance * std::abs(solution.lambda[i]));
  }
  return std::numeric_limits<double>::epsilon() * largest / velocityScale(problem);
}

}  // namespace tumble
