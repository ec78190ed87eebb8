// The boxed LCP: conditions of the solution, singular and impossible problems.
#include "sim/problem/lcp.h"

#include <limits>
#include <vector>

#include "tests/catch.h"
#include "tests/problem/problems.h"

using namespace tumble;
using tumble::test::Draw;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Lcp {
  MatX A;
  VecX b, lo, hi;
};

/// A = G Gᵀ of rank ≤ `rank` with small integer entries, so that it holds exactly in doubles;
/// b = A x − s with a solution (x, s), or any b when A has full rank. Rows double at random.
Lcp randomLcp(Draw& draw, int n, int rank) {
  MatX G(n, rank);
  for (int i = 0; i < n; ++i) {
    const bool twin = i > 0 && draw(0.0, 1.0) < 0.2;
    const int other = i > 0 ? draw.below(i) : 0;
    for (int k = 0; k < rank; ++k) G(i, k) = draw.below(9) - 4;
    if (twin) G.row(i) = G.row(other);
  }
  Lcp lcp{G * G.transpose(), VecX(n), VecX::Zero(n), VecX::Constant(n, kInfinity)};
  VecX x(n), slack(n);
  for (int i = 0; i < n; ++i) {
    const double kind = draw(0.0, 1.0);
    const double size = draw.below(6);
    x[i] = size;
    slack[i] = 0.0;
    if (kind < 0.2) {
      lcp.lo[i] = -kInfinity;
    } else if (kind < 0.4) {
      lcp.lo[i] = -3.0;
      lcp.hi[i] = 3.0;
      x[i] = size - 3.0;
      if (size == 0.0) slack[i] = draw.below(5);
      if (x[i] > 2.0 || x[i] == 2.0) x[i] = 3.0, slack[i] = -draw.below(5);
    } else if (kind < 0.7) {
      x[i] = 0.0;
      slack[i] = draw.below(5);
    }
  }
  lcp.b = slack - lcp.A * x;
  return lcp;
}

/// Worst violation of bounds and conditions, over the largest |b|.
double violation(const Lcp& lcp, const VecX& f) {
  const VecX a = lcp.A * f + lcp.b;
  double worst = 0.0;
  for (int i = 0; i < f.size(); ++i) {
    REQUIRE(std::isfinite(f[i]));
    worst = std::max({worst, lcp.lo[i] - f[i], f[i] - lcp.hi[i]});
    if (f[i] < lcp.hi[i]) worst = std::max(worst, -a[i]);
    if (f[i] > lcp.lo[i]) worst = std::max(worst, a[i]);
  }
  return worst / std::max(1.0, lcp.b.lpNorm<Eigen::Infinity>());
}

}  // namespace

// Oracle: the conditions themselves. Measured 6e-15, allowed 1e-12.
TEST_CASE("every consistent LCP, of any rank and with doubled rows, is solved") {
  Draw draw(1);
  for (int trial = 0; trial < 10000; ++trial) {
    const int n = 1 + draw.below(40);
    const Lcp lcp = randomLcp(draw, n, 1 + draw.below(n));
    VecX f;
    const LcpReport report = solveLcp(lcp.A, lcp.b, lcp.lo, lcp.hi, f);
    CAPTURE(trial, n, report.pivots, report.residual);
    REQUIRE(report.status == SolveStatus::Solved);
    REQUIRE(violation(lcp, f) < 1e-12);
    REQUIRE(report.residual < 1e-12);
  }
}

// Oracle: there is no solution. A row nobody can move, and two rows that ask for different things.
TEST_CASE("an LCP without a solution is reported, and its f stays finite") {
  const VecX nothing = VecX::Zero(2), endless = VecX::Constant(2, kInfinity);
  VecX f;
  const MatX still = (MatX(2, 2) << 1, 0, 0, 0).finished();
  CHECK(solveLcp(still, VecX::Constant(2, -1.0), nothing, endless, f).status ==
        SolveStatus::Infeasible);
  CHECK(f.allFinite());
  CHECK(f[0] == Approx(1.0));
  const MatX twins = MatX::Ones(2, 2);
  const VecX wishes = (VecX(2) << 0.0, 1.0).finished();
  CHECK(solveLcp(twins, wishes, -endless, endless, f).status == SolveStatus::Infeasible);
  CHECK(f.allFinite());
  CHECK(solveLcp(twins, VecX::Ones(2), -endless, endless, f).status == SolveStatus::Solved);
}

// Oracle: the cap of 50 n + 200; Dantzig needs about n pivots when nothing is degenerate, and three
// times that on the problem below. Measured 275 for n = 100.
TEST_CASE("pivots grow about as fast as the number of rows") {
  Draw draw(5);
  const int n = 100;
  MatX G(n, n / 2);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n / 2; ++k) G(i, k) = draw(-1.0, 1.0);
  VecX x(n / 2);
  for (int k = 0; k < n / 2; ++k) x[k] = draw(-1.0, 1.0);
  VecX f;
  const LcpReport report =
      solveLcp(G * G.transpose(), G * x, VecX::Zero(n), VecX::Constant(n, kInfinity), f);
  CHECK(report.status == SolveStatus::Solved);
  CHECK(report.pivots < 6 * n);
}

// Oracle: construction. Equalities of any rank whose b lies in the range of A are solved to
// rounding, and of b outside of it there is no solution. Measured 2e-13, allowed 1e-10.
TEST_CASE("equalities that repeat each other are solved, those that contradict are told") {
  Draw draw(57);
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 2 + draw.below(12), rank = 1 + draw.below(n);
    MatX G(n, rank);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < rank; ++k) G(i, k) = draw.below(9) - 4;
    const MatX A = G * G.transpose();
    VecX x(n), f;
    for (int i = 0; i < n; ++i) x[i] = draw.below(9) - 4;
    const VecX all = VecX::Constant(n, kInfinity), b = -A * x;
    CAPTURE(trial, n, rank);
    LcpReport report = solveLcp(A, b, -all, all, f);
    CHECK(report.status == SolveStatus::Solved);
    CHECK((A * f + b).lpNorm<Eigen::Infinity>() <= 1e-10 * (1.0 + b.lpNorm<Eigen::Infinity>()));

    // Something that no f can reach.
    const Eigen::FullPivLU<MatX> lu(A);
    if (lu.rank() == n) continue;
    const VecX outside = lu.kernel().col(0).normalized();
    report = solveLcp(A, b + outside, -all, all, f);
    CHECK(report.status == SolveStatus::Infeasible);
    CHECK(f.allFinite());
  }
}
