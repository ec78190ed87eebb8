#include "sim/problem/delassus.h"

namespace tumble {
namespace {

/// Ji M⁻¹ Jjᵀ through one body, given its side of both rows.
double through(const Problem& problem, int body, const Vec3& li, const Vec3& wi, const Vec3& lj,
               const Vec3& wj) {
  return problem.invM[body] * li.dot(lj) + wi.dot(problem.Iinv[body] * wj);
}

double coupling(const Problem& problem, const Row& i, const Row& j) {
  double sum = 0.0;
  if (i.a == j.a) sum += through(problem, i.a, i.linear, i.angularA, j.linear, j.angularA);
  if (i.b == j.b) sum += through(problem, i.b, i.linear, i.angularB, j.linear, j.angularB);
  if (i.a == j.b) sum += through(problem, i.a, i.linear, i.angularA, -j.linear, j.angularB);
  if (i.b == j.a) sum += through(problem, i.b, -i.linear, i.angularB, j.linear, j.angularA);
  return sum;
}

}  // namespace

void delassus(const Problem& problem, Eigen::Ref<MatX> A, Eigen::Ref<VecX> b) {
  const int n = static_cast<int>(problem.rows.size());
  rowVelocities(problem, problem.vStar, {b.data(), problem.rows.size()});
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j)
      A(i, j) = A(j, i) = coupling(problem, problem.rows[i], problem.rows[j]);
    A(i, i) += problem.rows[i].compliance;
  }
}

void delassus(const Problem& problem, std::span<const int> rows, Eigen::Ref<MatX> A) {
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    for (Eigen::Index j = 0; j <= i; ++j)
      A(i, j) = A(j, i) = coupling(problem, problem.rows[rows[i]], problem.rows[rows[j]]);
    A(i, i) += problem.rows[rows[i]].compliance;
  }
}

Delassus delassus(const Problem& problem) {
  const auto n = static_cast<Eigen::Index>(problem.rows.size());
  Delassus result{MatX(n, n), VecX(n)};
  delassus(problem, result.A, result.b);
  return result;
}

}  // namespace tumble
