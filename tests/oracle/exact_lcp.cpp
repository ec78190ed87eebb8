#include "tests/oracle/exact_lcp.h"

#include <CGAL/Gmpq.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace tumble::test {
namespace {

using Rational = CGAL::Gmpq;
using Program = CGAL::Quadratic_program<Rational>;
using Rationals = std::vector<Rational>;
using Matrix = std::vector<Rationals>;

struct Bounds {
  double lo, hi;
};

Rational rational(double x) {
  return Rational(x);
}

/// f of the boxed LCP, nothing if there is none.
std::optional<Rationals> minimise(const Matrix& A, const Rationals& b,
                                  const std::vector<Bounds>& bounds) {
  // The objective takes 2 D: CGAL writes fᵀD f + cᵀf.
  Program program(CGAL::SMALLER, false, 0, false, 0);
  const int n = static_cast<int>(b.size());
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) program.set_d(i, j, A[i][j]);
    program.set_c(i, b[i]);
    if (std::isfinite(bounds[i].lo)) program.set_l(i, true, rational(bounds[i].lo));
    if (std::isfinite(bounds[i].hi)) program.set_u(i, true, rational(bounds[i].hi));
  }

  auto solution = CGAL::solve_quadratic_program(program, Rational());
  if (!solution.solves_quadratic_program(program))
    throw std::logic_error("CGAL: " + solution.get_error());
  if (!solution.is_optimal()) return {};
  Rationals f;
  for (auto x = solution.variable_values_begin(); x != solution.variable_values_end(); ++x)
    f.push_back(x->numerator() / x->denominator());
  return f;
}

Rational rowProduct(const Rationals& row, const Rationals& f) {
  Rational result = 0;
  for (std::size_t i = 0; i < f.size(); ++i) result += row[i] * f[i];
  return result;
}

using Side = std::array<Rational, 6>;

Side side(const Vec3& linear, const Vec3& angular) {
  Side result;
  for (int k = 0; k < 3; ++k) {
    result[k] = rational(linear[k]);
    result[3 + k] = rational(angular[k]);
  }
  return result;
}

/// M⁻¹ of one body times a column.
Side push(const Problem& problem, int body, const Side& j) {
  Side result;
  for (int k = 0; k < 3; ++k) {
    result[k] = rational(problem.invM[body]) * j[k];
    for (int l = 0; l < 3; ++l) result[3 + k] += rational(problem.Iinv[body](k, l)) * j[3 + l];
  }
  return result;
}

Rational sideProduct(const Side& a, const Side& b) {
  Rational result = 0;
  for (int k = 0; k < 6; ++k) result += a[k] * b[k];
  return result;
}

/// The two ends of a row of J, and of M⁻¹ Jᵀ.
struct Ends {
  int a, b;
  Side Ja, Jb, pushA, pushB;
};

Rational coupling(const Ends& i, const Ends& j) {
  Rational result = 0;
  if (i.a == j.a) result += sideProduct(i.Ja, j.pushA);
  if (i.a == j.b) result += sideProduct(i.Ja, j.pushB);
  if (i.b == j.a) result += sideProduct(i.Jb, j.pushA);
  if (i.b == j.b) result += sideProduct(i.Jb, j.pushB);
  return result;
}

std::vector<Side> freeMotion(const Problem& problem) {
  std::vector<Side> v;
  for (const Vec6& twist : problem.vStar) v.push_back(side(twist.head<3>(), twist.tail<3>()));
  return v;
}

}  // namespace

std::optional<VecX> exactAccelerations(const MatX& A, const VecX& b, const VecX& lo,
                                       const VecX& hi) {
  const int n = static_cast<int>(b.size());
  Matrix matrix(n, Rationals(n));
  Rationals vector;
  std::vector<Bounds> bounds;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) matrix[i][j] = rational(A(i, j));
    vector.push_back(rational(b[i]));
    bounds.push_back({lo[i], hi[i]});
  }
  const std::optional<Rationals> f = minimise(matrix, vector, bounds);
  if (!f) return {};
  VecX a(n);
  for (int i = 0; i < n; ++i) a[i] = CGAL::to_double(rowProduct(matrix[i], *f) + vector[i]);
  return a;
}

std::optional<std::vector<Vec6>> exactMotion(const Problem& problem) {
  // Rows with both their ends.
  std::vector<Ends> ends;
  for (const Row& row : problem.rows) {
    Ends& end = ends.emplace_back(Ends{
        row.a, row.b, side(row.linear, row.angularA), side(-row.linear, row.angularB), {}, {}});
    end.pushA = push(problem, row.a, end.Ja);
    end.pushB = push(problem, row.b, end.Jb);
  }

  // A = J M⁻¹ Jᵀ, b = J vStar + bias.
  std::vector<Side> v = freeMotion(problem);
  const std::size_t n = ends.size();
  Matrix A(n, Rationals(n));
  Rationals b(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) A[i][j] = coupling(ends[i], ends[j]);
    b[i] = sideProduct(ends[i].Ja, v[ends[i].a]) + sideProduct(ends[i].Jb, v[ends[i].b]) +
           rational(problem.rows[i].bias);
  }
  std::vector<Bounds> bounds(n, {-INFINITY, INFINITY});
  for (const Cone& cone : problem.cones) {
    if (cone.kind == ConeKind::Push) bounds[cone.row].lo = 0.0;
    if (cone.kind == ConeKind::Friction || cone.kind == ConeKind::Slide)
      throw std::invalid_argument("exactMotion: a cone with friction");
  }
  const std::optional<Rationals> f = minimise(A, b, bounds);
  if (!f) return {};

  // v = vStar + M⁻¹ Jᵀ f.
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k < 6; ++k) {
      v[ends[i].a][k] += ends[i].pushA[k] * (*f)[i];
      v[ends[i].b][k] += ends[i].pushB[k] * (*f)[i];
    }
  }
  std::vector<Vec6> rounded(v.size());
  for (std::size_t body = 0; body < v.size(); ++body)
    for (int k = 0; k < 6; ++k) rounded[body][k] = CGAL::to_double(v[body][k]);
  return rounded;
}

}  // namespace tumble::test
