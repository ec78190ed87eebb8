#include "sim/problem/direct.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "sim/math/least_squares.h"
#include "sim/problem/cone.h"
#include "sim/problem/equalities.h"
#include "sim/problem/friction_block.h"
#include "sim/problem/row.h"

namespace tumble {
namespace {

/// How two bodies move, as a row sees it: a against b, and how each turns.
struct Motion {
  Vec3 v, omegaA, omegaB;
};

Motion motionOf(const Vec6& a, const Vec6& b) {
  return {a.head<3>() - b.head<3>(), a.tail<3>(), b.tail<3>()};
}

/// The sizes of its terms.
Motion sizesOf(const Vec6& a, const Vec6& b) {
  return {a.head<3>().cwiseAbs() + b.head<3>().cwiseAbs(), a.tail<3>().cwiseAbs(),
          b.tail<3>().cwiseAbs()};
}

double speedOf(const Row& row, const Motion& motion) {
  return row.linear.dot(motion.v) + row.angularA.dot(motion.omegaA) +
         row.angularB.dot(motion.omegaB);
}

/// Sum of the sizes of all terms of u, where `sizes` has those of the motion.
double termsOf(const Row& row, const Motion& sizes) {
  return row.linear.cwiseAbs().dot(sizes.v) + row.angularA.cwiseAbs().dot(sizes.omegaA) +
         row.angularB.cwiseAbs().dot(sizes.omegaB) + std::abs(row.bias);
}

/// λ of one contact, whose rows go with W λ + c: a quotient, or what solveFrictionBlock finds.
using One = Eigen::Matrix<double, 1, 1>;
One forceOf(const Cone&, const One& W, const One& c) {
  return One(c[0] >= 0.0 ? 0.0 : -c[0] / W[0]);
}
Vec3 forceOf(const Cone& cone, const Mat3& W, const Vec3& c) {
  return solveFrictionBlock(W, c, cone.mu, Vec3::Zero());
}

/// Adds what the λ of rows between two bodies give to their velocities.
void push(const Problem& problem, std::span<const Row> rows, const double* lambda, Vec6& va,
          Vec6& vb) {
  const int a = rows[0].a, b = rows[0].b;
  Vec3 impulse = Vec3::Zero(), twistA = Vec3::Zero(), twistB = Vec3::Zero();
  for (std::size_t j = 0; j < rows.size(); ++j) {
    impulse += lambda[j] * rows[j].linear;
    twistA += lambda[j] * rows[j].angularA;
    twistB += lambda[j] * rows[j].angularB;
  }
  va.head<3>() += problem.invM[a] * impulse;
  vb.head<3>() -= problem.invM[b] * impulse;
  va.tail<3>() += Vec3(problem.Iinv[a] * twistA);
  vb.tail<3>() += Vec3(problem.Iinv[b] * twistB);
}

/// One contact of so many rows, alone: λ, v and the residual that they leave, each term once.
template <int kRows>
[[gnu::flatten]] SolveReport solveContact(const Problem& problem, Solution& found) {
  const Cone& cone = problem.cones[0];
  const Row* rows = &problem.rows[cone.row];
  const int a = rows->a, b = rows->b;
  const double invA = problem.invM[a], invB = problem.invM[b];
  Vec6 va = problem.vStar[a], vb = problem.vStar[b];
  const Motion star = motionOf(va, vb), sizes = sizesOf(va, vb);
  Eigen::Matrix<double, kRows, kRows> W;
  Eigen::Matrix<double, kRows, 1> c;
  double mobility = 0.0, largest = 0.0, terms = 0.0;
  for (int j = 0; j < kRows; ++j) {
    const Row& row = rows[j];
    const Motion pushed{invA * row.linear + invB * row.linear, problem.Iinv[a] * row.angularA,
                        problem.Iinv[b] * row.angularB};
    for (int i = 0; i < kRows; ++i) W(i, j) = speedOf(rows[i], pushed);
    c[j] = speedOf(row, star) + row.bias;
    mobility = std::max(mobility, W(j, j));
    largest = std::max(largest, std::abs(c[j]));
    terms = std::max(terms, termsOf(row, sizes));
  }
  const Eigen::Matrix<double, kRows, 1> lambda = forceOf(cone, W, c);
  push(problem, {rows, kRows}, lambda.data(), va, vb);

  double u[kRows];
  const Motion after = motionOf(va, vb);
  for (int j = 0; j < kRows; ++j) u[j] = speedOf(rows[j], after) + rows[j].bias;
  SolveReport report{.scale = velocityScale(largest, terms)};
  const double rho = mobility > 0.0 ? 1.0 / mobility : 1.0;
  report.residual = coneResidual(cone, lambda.data(), u, rho) / report.scale;
  found.lambda.assign(lambda.data(), lambda.data() + kRows);
  found.v = problem.vStar;
  found.v[a] = va;
  found.v[b] = vb;
  return report;
}

/// λ of equalities, and what rounding left of it twice again. False where that would take too long.
/// @param share  SolveSettings::dependent
bool solveEqualities(const Problem& problem, double share, std::vector<double>& found) {
  constexpr int kAgain = 2;
  thread_local Equalities equalities;
  if (!equalities.factor(problem, share)) return false;
  found.assign(problem.rows.size(), 0.0);
  for (int k = 0; k <= kAgain; ++k) equalities.solve(problem, found);
  return true;
}

/// λ and v, where the problem is one of those that need no search, whatever residual they leave.
std::optional<SolveReport> solveAtOnce(const Problem& problem, double dependent, Solution& found) {
  constexpr std::size_t kMostRows = 300;  // sparse factors are faster beyond
  const auto is = [&](ConeKind kind) {
    return std::all_of(problem.cones.begin(), problem.cones.end(),
                       [&](const Cone& cone) { return cone.kind == kind; });
  };
  const bool one = problem.cones.size() == 1;
  const bool few = !problem.cones.empty() && problem.rows.size() <= kMostRows;
  if (one && is(ConeKind::Push)) return solveContact<1>(problem, found);
  if (one && is(ConeKind::Friction)) return solveContact<3>(problem, found);
  if (!few || !is(ConeKind::Equality) || !solveEqualities(problem, dependent, found.lambda))
    return std::nullopt;
  found.v.resize(problem.vStar.size());
  velocitiesFromLambda(problem, found.lambda, found.v);
  SolveReport report{.scale = velocityScale(problem)};
  report.residual = naturalResidual(problem, found, report.scale);
  return report;
}

}  // namespace

std::optional<SolveReport> solveDirect(const Problem& problem, const SolveSettings& settings,
                                       Solution& solution) {
  thread_local Solution found;  // keeps its storage from call to call
  const double dependent = std::max(settings.dependent, LeastSquares::kDependent);
  const std::optional<SolveReport> report = solveAtOnce(problem, dependent, found);
  if (!report) return std::nullopt;
  // Rows that follow from others but for a share of the largest contradict them by its root.
  const double most = dependent > LeastSquares::kDependent
                          ? std::max(settings.tolerance, std::sqrt(dependent))
                          : settings.tolerance;
  if (!(report->residual <= most) && !atRounding(problem, found, report->residual))
    return std::nullopt;
  std::swap(solution, found);
  return report;
}

}  // namespace tumble
