#include "sim/problem/direct.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "sim/math/least_squares.h"
#include "sim/problem/cone.h"
#include "sim/problem/delassus.h"
#include "sim/problem/friction_block.h"
#include "sim/problem/row.h"

namespace tumble {
namespace {

/// M⁻¹ Jᵀ of one row, for both bodies.
std::pair<Vec6, Vec6> yieldTo(const Problem& problem, const Row& row) {
  std::pair<Vec6, Vec6> yield;
  yield.first.head<3>() = problem.invM[row.a] * row.linear;
  yield.first.tail<3>() = problem.Iinv[row.a] * row.angularA;
  yield.second.head<3>() = -problem.invM[row.b] * row.linear;
  yield.second.tail<3>() = problem.Iinv[row.b] * row.angularB;
  return yield;
}

/// One contact without friction, λ = −u/W where u < 0: λ, v and the residual that they leave.
[[gnu::flatten]] SolveReport solvePush(const Problem& problem, Solution& found) {
  const Row& row = problem.rows[problem.cones[0].row];
  const double u = rowVelocity(row, problem.vStar), terms = termsOf(row, problem.vStar);
  const Vec3 turnA = problem.Iinv[row.a] * row.angularA, turnB = problem.Iinv[row.b] * row.angularB;
  const Vec3 moveA = problem.invM[row.a] * row.linear, moveB = -problem.invM[row.b] * row.linear;
  const double W =
      row.linear.dot(moveA - moveB) + row.angularA.dot(turnA) + row.angularB.dot(turnB);
  const double lambda = u >= 0.0 ? 0.0 : -u / W;

  found.lambda.assign(1, lambda);
  found.v = problem.vStar;
  const auto push = [&](int body, const Vec3& linear, const Vec3& angular) {
    const Vec3 turn = problem.Iinv[body] * angular;
    found.v[body].head<3>() += problem.invM[body] * linear;
    found.v[body].tail<3>() += turn;
  };
  push(row.a, lambda * row.linear, lambda * row.angularA);
  push(row.b, -lambda * row.linear, lambda * row.angularB);
  const double left = rowVelocity(row, found.v), rho = W > 0.0 ? 1.0 / W : 1.0;
  SolveReport report{.scale = velocityScale(std::abs(u), terms)};
  report.residual = coneResidual(problem.cones[0], &lambda, &left, rho) / report.scale;
  return report;
}

/// λ of one contact with friction: solveFrictionBlock finds it.
[[gnu::flatten]] void solveFriction(const Problem& problem, std::vector<double>& found) {
  const Cone& cone = problem.cones[0];
  Mat3 W;
  Vec3 c;
  for (int j = 0; j < 3; ++j) {
    const Row& row = problem.rows[cone.row + j];
    const auto [a, b] = yieldTo(problem, row);
    for (int i = 0; i < 3; ++i) W(i, j) = rowSpeed(problem.rows[cone.row + i], a, b);
    c[j] = rowSpeed(row, problem.vStar[row.a], problem.vStar[row.b]) + row.bias;
  }
  const Vec3 lambda = solveFrictionBlock(W, c, cone.mu, Vec3::Zero());
  found.assign(lambda.data(), lambda.data() + 3);
}

constexpr std::size_t kMostDependent = 60;  ///< rows that depend on each other

/// What solveEqualities works with; kept for the sake of its storage, which only grows.
struct EqualityWork {
  std::vector<double> A, L, u;
  std::vector<Vec6> v;
  std::array<LeastSquares, kMostDependent + 1> dependent;  ///< per number of rows
};

/// λ of equalities: A λ + b = 0 by Cholesky, or the smallest λ by least squares where rows depend
/// on each other; and what rounding left of it twice again. False where that would take too long.
bool solveEqualities(const Problem& problem, std::vector<double>& found) {
  constexpr int kAgain = 2;
  constexpr double kSingular = 1e-7;  // of the root of a diagonal entry
  thread_local EqualityWork work;
  const std::size_t rows = problem.rows.size();
  const auto n = static_cast<Eigen::Index>(rows);
  work.A.resize(rows * rows);
  work.L.resize(rows * rows);
  work.u.resize(rows);
  Eigen::Map<MatX> A(work.A.data(), n, n), L(work.L.data(), n, n);
  Eigen::Map<VecX> u(work.u.data(), n);
  delassus(problem, A, u);
  L = A;
  const Eigen::LLT<Eigen::Ref<MatX>> factor(L);  // in its place
  const auto pivots = L.diagonal().array();
  const bool regular =
      factor.info() == Eigen::Success && (pivots > kSingular * A.diagonal().array().sqrt()).all();
  if (!regular && rows > kMostDependent) return false;
  LeastSquares* const dependent = regular ? nullptr : &work.dependent[rows];
  if (dependent) dependent->factor(A);

  found.assign(rows, 0.0);
  Eigen::Map<VecX> lambda(found.data(), n);
  work.v.resize(problem.vStar.size());
  for (int k = 0; k <= kAgain; ++k) {
    if (dependent) {
      lambda -= dependent->solve(u);
    } else {
      factor.solveInPlace(u);
      lambda -= u;
    }
    velocitiesFromLambda(problem, found, work.v);
    rowVelocities(problem, work.v, work.u);
  }
  return true;
}

/// λ and v, where the problem is one of those that need no search, whatever residual they leave.
std::optional<SolveReport> solveAtOnce(const Problem& problem, Solution& found) {
  constexpr std::size_t kMostRows = 300;  // sparse factors are faster beyond
  const auto is = [&](ConeKind kind) {
    return std::all_of(problem.cones.begin(), problem.cones.end(),
                       [&](const Cone& cone) { return cone.kind == kind; });
  };
  const bool one = problem.cones.size() == 1;
  const bool few = !problem.cones.empty() && problem.rows.size() <= kMostRows;
  if (one && is(ConeKind::Push)) return solvePush(problem, found);
  if (one && is(ConeKind::Friction)) {
    solveFriction(problem, found.lambda);
  } else if (!few || !is(ConeKind::Equality) || !solveEqualities(problem, found.lambda)) {
    return std::nullopt;
  }
  found.v.resize(problem.vStar.size());
  velocitiesFromLambda(problem, found.lambda, found.v);
  SolveReport report{.scale = velocityScale(problem)};
  report.residual = naturalResidual(problem, found, report.scale);
  return report;
}

}  // namespace

std::optional<SolveReport> solveDirect(const Problem& problem, double tolerance,
                                       Solution& solution) {
  thread_local Solution found;  // keeps its storage from call to call
  const std::optional<SolveReport> report = solveAtOnce(problem, found);
  if (!report) return std::nullopt;
  if (!(report->residual <= tolerance) && !atRounding(problem, found, report->residual))
    return std::nullopt;
  std::swap(solution, found);
  return report;
}

}  // namespace tumble
