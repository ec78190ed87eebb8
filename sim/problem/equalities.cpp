#include "sim/problem/equalities.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "sim/problem/delassus.h"
#include "sim/problem/row.h"

namespace tumble {

bool Equalities::factorRegular(const Problem& problem, double dependent) {
  constexpr double kSingular = 1e-7;  // of the root of a diagonal entry
  places_.clear();
  for (const Cone& cone : problem.cones)
    if (cone.kind == ConeKind::Equality) places_.push_back(cone.row);
  const std::size_t rows = places_.size();
  const auto n = static_cast<Eigen::Index>(rows);
  A_.resize(rows * rows);
  L_.resize(rows * rows);
  u_.resize(rows);
  arms_.resize(rows);
  Eigen::Map<MatX> A(A_.data(), n, n), L(L_.data(), n, n);
  delassus(problem, places_, A);
  L = A;
  const Eigen::LLT<Eigen::Ref<MatX>> factor(L);  // in its place
  const auto pivots = L.diagonal().array();
  dependent_ = nullptr;
  return factor.info() == Eigen::Success &&
         (pivots > std::max(kSingular, std::sqrt(dependent)) * A.diagonal().array().sqrt()).all();
}

bool Equalities::factor(const Problem& problem, double dependent) {
  if (factorRegular(problem, dependent)) return true;
  const std::size_t rows = places_.size();
  const auto n = static_cast<Eigen::Index>(rows);
  if (rows > kMostDependent) return false;
  Eigen::Map<MatX> A(A_.data(), n, n);
  dependent_ = &leastOfSize_[rows];
  for (Eigen::Index i = 0; i < n; ++i) {  // by forces, in whatever units torques are
    const double arm = arms_[i] = rowArm(problem, problem.rows[places_[i]]);
    A.row(i) *= arm;
    A.col(i) *= arm;
  }
  dependent_->factor(A, dependent);
  return true;
}

void Equalities::solve(const Problem& problem, std::span<double> lambda) {
  const auto n = static_cast<Eigen::Index>(places_.size());
  Eigen::Map<VecX> u(u_.data(), n), arms(arms_.data(), n);
  v_.resize(problem.vStar.size());
  velocitiesFromLambda(problem, lambda, v_);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Row& row = problem.rows[places_[i]];
    u[i] = rowVelocity(row, v_) + row.compliance * lambda[places_[i]];
  }
  if (dependent_) {
    u.array() *= arms.array();
    u = arms.cwiseProduct(dependent_->solve(u));
  } else {
    const Eigen::Map<const MatX> L(L_.data(), n, n);
    L.triangularView<Eigen::Lower>().solveInPlace(u);
    L.adjoint().triangularView<Eigen::Upper>().solveInPlace(u);
  }
  for (Eigen::Index i = 0; i < n; ++i) lambda[places_[i]] -= u[i];
}

}  // namespace tumble
