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

/// λ of one contact without friction:  λ = −u/W  where u < 0.
[[gnu::flatten]] double pushOf(const Problem& problem) {
  const Row& row = problem.rows[problem.cones[0].row];
  const double u = rowSpeed(row, problem.vStar[row.a], problem.vStar[row.b]) + row.bias;
  if (u >= 0.0) return 0.0;
  const auto [a, b] = yieldTo(problem, row);
  return -u / rowSpeed(row, a, b);
}

/// λ of one contact: solveFrictionBlock finds it where there is friction.
[[gnu::flatten]] void solveContact(const Problem& problem, std::vector<double>& found) {
  const Cone& cone = problem.cones[0];
  if (cone.kind == ConeKind::Push) return found.assign(1, pushOf(problem));
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

/// λ, where the problem is one of those that need no search.
bool findForces(const Problem& problem, std::vector<double>& found) {
  constexpr std::size_t kMostRows = 300;  // sparse factors are faster beyond
  const auto is = [&](ConeKind kind) {
    return std::all_of(problem.cones.begin(), problem.cones.end(),
                       [&](const Cone& cone) { return cone.kind == kind; });
  };
  if (problem.cones.size() == 1 && (is(ConeKind::Push) || is(ConeKind::Friction))) {
    solveContact(problem, found);
    return true;
  }
  const bool few = !problem.cones.empty() && problem.rows.size() <= kMostRows;
  return few && is(ConeKind::Equality) && solveEqualities(problem, found);
}

}  // namespace

std::optional<SolveReport> solveDirect(const Problem& problem, double tolerance,
                                       Solution& solution) {
  thread_local Solution found;  // keeps its storage from call to call
  if (!findForces(problem, found.lambda)) return std::nullopt;
  found.v.resize(problem.vStar.size());
  velocitiesFromLambda(problem, found.lambda, found.v);
  SolveReport report;
  report.residual = naturalResidual(problem, found);
  if (!(report.residual <= tolerance) && !atRounding(problem, found, report.residual))
    return std::nullopt;
  std::swap(solution, found);
  return report;
}

}  // namespace tumble
