#include "sim/problem/sweep.h"

#include <algorithm>
#include <cmath>

#include "sim/problem/cone.h"
#include "sim/problem/friction_block.h"

namespace tumble {
namespace {

constexpr double kTurn = 1e-4;  ///< [rad] of a slip direction: the next sweeps do the rest

/// L with A = L Lᵀ for a positive semidefinite A; a direction that A does not know gets 0.
Mat3 rootOf(const Mat3& A) {
  const double floor = 1e-15 * A.trace();
  Mat3 L = Mat3::Zero();
  for (int j = 0; j < 3; ++j) {
    double pivot = A(j, j);
    for (int k = 0; k < j; ++k) pivot -= L(j, k) * L(j, k);
    if (!(pivot > floor)) continue;
    L(j, j) = std::sqrt(pivot);
    for (int i = j + 1; i < 3; ++i) {
      double sum = A(i, j);
      for (int k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);
      L(i, j) = sum / L(j, j);
    }
  }
  return L;
}

/// λ of a cone without friction, or with that of a known direction.
Vec3 solveOther(const SweptCone& cone, const Vec3& u, const Vec3& old) {
  const Vec3 free = u - cone.W.lazyProduct(old);
  if (cone.kind == ConeKind::Equality) return {-free[0] / cone.W(0, 0), 0.0, 0.0};
  if (cone.kind == ConeKind::Push) return {std::max(-free[0] / cone.W(0, 0), 0.0), 0.0, 0.0};
  const double mobility = cone.W(0, 0) - cone.mu * cone.W(0, 1);
  const double push = mobility > 0.0 ? std::max(-free[0] / mobility, 0.0) : 0.0;
  return {push, -cone.mu * push, 0.0};
}

/// λ of a contact with friction at which it is now u fast: open, or held, or sliding.
Vec3 solveFriction(const SweptCone& cone, const Vec3& u, const Vec3& old) {
  const Vec3 free = u - cone.W.lazyProduct(old);
  if (free[0] >= 0.0) return Vec3::Zero();
  const Vec3 held = old - cone.hold.lazyProduct(u);
  const double bound = cone.mu * held[0];
  const bool holds = cone.hold(0, 0) > 0.0;
  if (holds && bound >= 0.0 && held[1] * held[1] + held[2] * held[2] <= bound * bound) return held;
  return slideFrictionBlock(cone.W, free, cone.mu, old, held, kTurn);
}

}  // namespace

void ConeSweeps::prepare(const Problem& problem) {
  roots_.resize(problem.invM.size());
  for (std::size_t i = 0; i < roots_.size(); ++i) roots_[i] = rootOf(problem.Iinv[i]);
  y_.resize(problem.invM.size());
  mobility_.setOnes(static_cast<Eigen::Index>(problem.rows.size()));
  cones_.resize(problem.cones.size());
  for (std::size_t k = 0; k < cones_.size(); ++k) layOut(problem, problem.cones[k], cones_[k]);
}

[[gnu::flatten]] void ConeSweeps::layOut(const Problem& problem, const Cone& from,
                                         SweptCone& cone) {
  cone.kind = from.kind;
  cone.mu = from.mu;
  cone.row = from.row;
  cone.a = problem.rows[from.row].a;
  cone.b = problem.rows[from.row].b;
  cone.Ka.setZero();
  cone.Kb.setZero();
  cone.c.setZero();
  const double rootA = std::sqrt(problem.invM[cone.a]), rootB = std::sqrt(problem.invM[cone.b]);
  for (int i = 0; i < coneRows(from.kind); ++i) {
    const Row& row = problem.rows[from.row + i];
    cone.Ka.col(i).head<3>() = rootA * row.linear;
    cone.Ka.col(i).tail<3>() = roots_[cone.a].transpose().lazyProduct(row.angularA);
    cone.Kb.col(i).head<3>() = -rootB * row.linear;
    cone.Kb.col(i).tail<3>() = roots_[cone.b].transpose().lazyProduct(row.angularB);
    cone.c[i] = rowSpeed(row, problem.vStar[row.a], problem.vStar[row.b]) + row.bias;
  }
  cone.W = cone.Ka.transpose().lazyProduct(cone.Ka);
  cone.W += cone.Kb.transpose().lazyProduct(cone.Kb);
  cone.mobility = cone.W.diagonal().maxCoeff();
  if (cone.kind == ConeKind::Friction) cone.hold = inverseOfBlock(cone.W);
  for (int i = 0; i < coneRows(from.kind); ++i)
    if (cone.W(i, i) > 0.0) mobility_[from.row + i] = cone.W(i, i);
}

[[gnu::flatten]] void ConeSweeps::take(const VecX& lambda) {
  for (Vec6& y : y_) y.setZero();
  for (const SweptCone& cone : cones_) {
    Vec3 own = Vec3::Zero();
    for (int i = 0; i < coneRows(cone.kind); ++i) own[i] = lambda[cone.row + i];
    y_[cone.a].noalias() += cone.Ka.lazyProduct(own);
    y_[cone.b].noalias() += cone.Kb.lazyProduct(own);
  }
}

/// Solves one cone and moves its bodies.
[[gnu::flatten]] double ConeSweeps::visit(const SweptCone& cone, double* lambda) {
  if (cone.mobility <= 0.0) return 0.0;
  const int rows = coneRows(cone.kind);
  Vec6 &ya = y_[cone.a], &yb = y_[cone.b];
  Vec3 u = Vec3::Zero(), old = Vec3::Zero();
  for (int i = 0; i < rows; ++i) {
    u[i] = (cone.Ka.col(i).cwiseProduct(ya) + cone.Kb.col(i).cwiseProduct(yb)).sum() + cone.c[i];
    old[i] = lambda[i];
  }
  const Vec3 next =
      cone.kind == ConeKind::Friction ? solveFriction(cone, u, old) : solveOther(cone, u, old);
  const Vec3 change = next - old;
  for (int i = 0; i < rows; ++i) lambda[i] = next[i];
  ya += cone.Ka.lazyProduct(change);
  yb += cone.Kb.lazyProduct(change);
  return change.lpNorm<Eigen::Infinity>() * cone.mobility;
}

double ConeSweeps::pass(bool forwards, VecX& lambda) {
  double largest = 0.0;
  const std::size_t n = cones_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const SweptCone& cone = cones_[forwards ? i : n - 1 - i];
    largest = std::max(largest, visit(cone, lambda.data() + cone.row));
  }
  return largest;
}

}  // namespace tumble
