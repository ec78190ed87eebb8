#include "sim/problem/single.h"

#include <array>

#include "sim/problem/cone.h"
#include "sim/problem/friction_block.h"

namespace tumble {
namespace {

/// M⁻¹ Jᵀ of one row, for both bodies.
std::pair<Vec6, Vec6> yieldTo(const Problem& problem, const Row& row) {
  Vec6 a, b;
  a << problem.invM[row.a] * row.linear, problem.Iinv[row.a] * row.angularA;
  b << -problem.invM[row.b] * row.linear, problem.Iinv[row.b] * row.angularB;
  return {a, b};
}

}  // namespace

std::optional<SolveReport> solveSingle(const Problem& problem, double tolerance,
                                       Solution& solution) {
  if (problem.cones.size() != 1) return std::nullopt;
  const Cone& cone = problem.cones[0];
  const bool rubs = cone.kind == ConeKind::Friction;
  if (!rubs && cone.kind != ConeKind::Push) return std::nullopt;
  const int rows = coneRows(cone.kind);

  Mat3 W = Mat3::Identity();
  Vec3 c = Vec3::Zero();
  for (int j = 0; j < rows; ++j) {
    const Row& row = problem.rows[cone.row + j];
    const auto [a, b] = yieldTo(problem, row);
    for (int i = 0; i < rows; ++i) W(i, j) = rowSpeed(problem.rows[cone.row + i], a, b);
    c[j] = rowSpeed(row, problem.vStar[row.a], problem.vStar[row.b]) + row.bias;
  }
  const Vec3 lambda = solveFrictionBlock(W, c, rubs ? cone.mu : 0.0, Vec3::Zero());

  Solution found;
  found.lambda.assign(lambda.data(), lambda.data() + rows);
  found.v.resize(problem.vStar.size());
  velocitiesFromLambda(problem, found.lambda, found.v);
  SolveReport report;
  report.residual = naturalResidual(problem, found);
  if (!(report.residual <= tolerance)) return std::nullopt;
  solution = std::move(found);
  return report;
}

}  // namespace tumble
