#include "tests/problem/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tumble::test {
namespace {

using Long = long double;
using Twist = std::array<Long, 6>;

/// A sum and the sum of the sizes of its terms.
struct Sum {
  Long value = 0.0L, size = 0.0L;

  void add(Long term) {
    value += term;
    size += std::abs(term);
  }
};
using Sums = std::array<Sum, 6>;

int rowsOf(const Cone& cone) {
  return cone.kind == ConeKind::Friction ? 3 : cone.kind == ConeKind::Slide ? 2 : 1;
}

/// J of one row on its body a (sign 1) or b (sign −1).
Twist end(const Row& row, bool b) {
  const Vec3& angular = b ? row.angularB : row.angularA;
  Twist result;
  for (int k = 0; k < 3; ++k) {
    result[k] = b ? -row.linear[k] : row.linear[k];
    result[3 + k] = angular[k];
  }
  return result;
}

/// M⁻¹ w of a body, the sizes going along.
Sums inverseMass(const Problem& problem, int body, const Sums& w) {
  Sums result;
  for (int k = 0; k < 3; ++k) {
    const Long inverse = problem.invM[body];
    result[k] = {inverse * w[k].value, inverse * w[k].size};
    for (int l = 0; l < 3; ++l) {
      const Long entry = problem.Iinv[body](k, l);
      result[3 + k].value += entry * w[3 + l].value;
      result[3 + k].size += std::abs(entry) * w[3 + l].size;
    }
  }
  return result;
}

/// vStar + M⁻¹ Jᵀ λ, and the sizes of its terms.
std::vector<Sums> motion(const Problem& problem, const std::vector<double>& lambda) {
  std::vector<Sums> v(problem.vStar.size());
  for (std::size_t i = 0; i < problem.rows.size(); ++i) {
    const Row& row = problem.rows[i];
    const Twist a = end(row, false), b = end(row, true);
    for (int k = 0; k < 6; ++k) {
      v[row.a][k].add(a[k] * lambda[i]);
      v[row.b][k].add(b[k] * lambda[i]);
    }
  }
  for (std::size_t body = 0; body < v.size(); ++body) {
    v[body] = inverseMass(problem, static_cast<int>(body), v[body]);
    for (int k = 0; k < 6; ++k) v[body][k].add(problem.vStar[body][k]);
  }
  return v;
}

Sum rowSum(const Row& row, const std::vector<Sums>& v) {
  Sum sum;
  sum.add(row.bias);
  const Twist a = end(row, false), b = end(row, true);
  for (int k = 0; k < 6; ++k) {
    const Sum &va = v[row.a][k], &vb = v[row.b][k];
    sum.value += a[k] * va.value + b[k] * vb.value;
    sum.size += std::abs(a[k]) * va.size + std::abs(b[k]) * vb.size;
  }
  return sum;
}

/// Diagonal entry of J M⁻¹ Jᵀ.
Long mobility(const Problem& problem, const Row& row) {
  Long result = 0.0L;
  for (const bool b : {false, true}) {
    const Twist j = end(row, b);
    Sums w;
    for (int k = 0; k < 6; ++k) w[k].add(j[k]);
    const Sums moved = inverseMass(problem, b ? row.b : row.a, w);
    for (int k = 0; k < 6; ++k) result += j[k] * moved[k].value;
  }
  return result;
}

/// (λ − Π_K(λ − ρ û))/ρ of one cone, the largest entry.
Long naturalMap(const Cone& cone, const double* lambda, const Long* u, Long rho) {
  if (cone.kind == ConeKind::Equality) return std::abs(u[0]);
  const Long mu = cone.mu;
  if (cone.kind != ConeKind::Friction) {
    // λ − max(λ − ρ u, 0), without the difference in which a large λ hides u.
    const Long push = std::abs(std::min(lambda[0] / rho, u[0]));
    if (cone.kind == ConeKind::Push) return push;
    return std::max(push, std::abs(lambda[1] + mu * lambda[0]) / rho);
  }
  const Long x = lambda[0] - rho * (u[0] + mu * std::hypot(u[1], u[2]));
  const Long y = lambda[1] - rho * u[1], z = lambda[2] - rho * u[2];
  const Long tangential = std::hypot(y, z);
  std::array<Long, 3> nearest = {x, y, z};
  if (x < 0.0L || tangential > mu * x) {
    const Long along = std::max((x + mu * tangential) / (1.0L + mu * mu), 0.0L);
    const Long shrink = tangential > 0.0L ? mu * along / tangential : 0.0L;
    nearest = {along, shrink * y, shrink * z};
  }
  Long worst = 0.0L;
  for (int k = 0; k < 3; ++k) worst = std::max(worst, std::abs(lambda[k] - nearest[k]) / rho);
  return worst;
}

}  // namespace

Worth worthOf(const Problem& problem, const Solution& solution) {
  Worth worth;
  for (double x : solution.lambda) worth.finite = worth.finite && std::isfinite(x);
  for (const Vec6& twist : solution.v) worth.finite = worth.finite && twist.allFinite();
  worth.finite = worth.finite && solution.lambda.size() == problem.rows.size() &&
                 solution.v.size() == problem.vStar.size();
  if (!worth.finite) {
    worth.residual = worth.balance = std::numeric_limits<double>::infinity();
    return worth;
  }

  // Newton's law: linear, then angular.
  const std::vector<Sums> pushed = motion(problem, solution.lambda);
  std::vector<Sums> v(problem.vStar.size()), start = v;
  for (int part : {0, 3}) {
    Long error = 0.0L, size = 0.0L;
    for (std::size_t body = 0; body < v.size(); ++body)
      for (int k = part; k < part + 3; ++k) {
        v[body][k].add(solution.v[body][k]);
        start[body][k].add(problem.vStar[body][k]);
        error = std::max(error, std::abs(solution.v[body][k] - pushed[body][k].value));
        size = std::max(size, pushed[body][k].size);
      }
    if (error > std::numeric_limits<double>::min())
      worth.balance =
          std::max(worth.balance, static_cast<double>(size > 0.0L ? error / size : error));
  }

  // The cones, by the velocities given.
  Long scale = 0.0L, worst = 0.0L, rounding = 0.0L;
  for (const Row& row : problem.rows) scale = std::max(scale, std::abs(rowSum(row, start).value));
  if (scale == 0.0L) scale = 1.0L;
  for (const Cone& cone : problem.cones) {
    std::array<Long, 3> u = {};
    Long largest = 0.0L;
    for (int k = 0; k < rowsOf(cone); ++k) {
      const Row& row = problem.rows[cone.row + k];
      u[k] = rowSum(row, v).value;
      largest = std::max(largest, mobility(problem, row));
      rounding = std::max(rounding, (1.0L + cone.mu) * rowSum(row, pushed).size);
    }
    const Long rho = largest > 0.0L ? 1.0L / largest : 1.0L;
    worst = std::max(worst, naturalMap(cone, &solution.lambda[cone.row], u.data(), rho));
  }
  worth.residual = static_cast<double>(worst / scale);
  worth.rounding = static_cast<double>(std::numeric_limits<double>::epsilon() * rounding / scale);
  return worth;
}

}  // namespace tumble::test
