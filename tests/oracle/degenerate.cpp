// Degenerate and unsolvable complementarity problems against exact arithmetic.
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <string>

#include "sim/problem/lcp.h"
#include "tests/catch.h"
#include "tests/oracle/exact_lcp.h"
#include "tests/problem/problems.h"
#include "tests/problem/random_contacts.h"

using namespace tumble;
using namespace tumble::test;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Lcp {
  MatX A;
  VecX b, lo, hi;
};

/// f ≥ 0.
Lcp pushing(const MatX& A, const VecX& b) {
  return {A, b, VecX::Zero(b.size()), VecX::Constant(b.size(), kInfinity)};
}

/// Small integers everywhere, so that doubles hold A = G Gᵀ and its rank exactly. Rows double, b
/// may be 0 or out of reach, some f are free and some bounded on both sides.
Lcp integerLcp(Draw& draw) {
  const int n = 1 + draw.below(12), rank = 1 + draw.below(n);
  MatX G(n, rank);
  for (int i = 0; i < n; ++i) {
    const bool twin = i > 0 && draw(0.0, 1.0) < 0.2;
    const int other = i > 0 ? draw.below(i) : 0;
    for (int k = 0; k < rank; ++k) G(i, k) = draw.below(7) - 3;
    const double side = draw(0.0, 1.0) < 0.3 ? -1.0 : 1.0;
    if (twin) G.row(i) = side * G.row(other);
  }
  Lcp lcp = pushing(G * G.transpose(), VecX::Zero(n));
  const bool reachable = draw(0.0, 1.0) < 0.6;
  VecX x(rank);
  for (int k = 0; k < rank; ++k) x[k] = draw.below(7) - 3;
  for (int i = 0; i < n; ++i) {
    const double slack = draw.below(3), any = draw.below(9) - 4;
    lcp.b[i] = reachable ? G.row(i).dot(x) + slack : any;
    const double kind = draw(0.0, 1.0);
    if (kind < 0.15) {
      lcp.lo[i] = -kInfinity;
      if (reachable) lcp.b[i] -= slack;
    } else if (kind < 0.3) {
      lcp.lo[i] = -2.0;
      lcp.hi[i] = 2.0;
    }
  }
  return lcp;
}

struct Outcome {
  bool solvable = false;
  double error = 0.0;  ///< of a, over |b| and the sizes of the terms of A f
  LcpReport report = {};
};

/// Solves both ways; the answer of sim must be that of the rationals, "none" included.
Outcome holdToExact(const Lcp& lcp) {
  const std::optional<VecX> exact = exactAccelerations(lcp.A, lcp.b, lcp.lo, lcp.hi);
  Outcome outcome{.solvable = exact.has_value()};
  VecX f;
  outcome.report = solveLcp(lcp.A, lcp.b, lcp.lo, lcp.hi, f);
  REQUIRE(f.allFinite());
  const VecX a = lcp.A * f + lcp.b;
  CHECK((outcome.report.status == SolveStatus::Solved) == outcome.solvable);
  if (!outcome.solvable) {
    CHECK(outcome.report.status == SolveStatus::Infeasible);
    return outcome;
  }
  const double largest = std::max(1.0, lcp.b.lpNorm<Eigen::Infinity>());
  const double terms =
      std::max(1.0, (lcp.A.cwiseAbs() * f.cwiseAbs()).lpNorm<Eigen::Infinity>() / largest);
  outcome.error = (a - *exact).lpNorm<Eigen::Infinity>() / (largest * terms);
  CHECK(outcome.report.residual < 1e-13 * terms);
  CHECK(outcome.error < 1e-10);
  return outcome;
}

/// Lower triangular, 1 on the diagonal and `below` under it.
MatX triangle(int n, double below) {
  MatX L = MatX::Identity(n, n);
  L.triangularView<Eigen::StrictlyLower>().setConstant(below);
  return L;
}

double worstDifference(const std::vector<Vec6>& one, const std::vector<Vec6>& other) {
  double worst = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i)
    worst = std::max(worst, (one[i] - other[i]).lpNorm<Eigen::Infinity>());
  return worst;
}

/// Returns what to print.
std::string compareIntegers(std::uint64_t seed, int count) {
  Draw draw(seed);
  double worst = 0.0;
  int none = 0, pivots = 0;
  for (int trial = 0; trial < count; ++trial) {
    const Lcp lcp = integerLcp(draw);
    CAPTURE(trial, lcp.b.size());
    const Outcome outcome = holdToExact(lcp);
    worst = std::max(worst, outcome.error);
    none += !outcome.solvable;
    pivots = std::max(pivots, outcome.report.pivots);
  }
  CHECK(none > count / 50);
  char text[100];
  std::snprintf(text, sizeof text, "%d LCPs: a within %.1e, %d have no answer, <= %d pivots", count,
                worst, none, pivots);
  return text;
}

}  // namespace

// Oracle: rationals. Measured 5e-16 of the terms of A f – 2e-11 in the
// long test – allowed 1e-10.
TEST_CASE("integer LCPs up to a dozen rows are solved, or have no answer, as in rationals") {
  compareIntegers(1, 500);
}

TEST_CASE("a hundred thousand integer LCPs are as in rationals", "[long][figures]") {
  WARN(compareIntegers(2, 100000));
}

// Oracle: rationals. Fathi, Computational Complexity of LCPs Associated with Positive Definite
// Symmetric Matrices, 1979: A = L Lᵀ with Murty's L, on which pivoting by least index takes 2ⁿ
// steps; b = −1, and −2ⁱ as Murty has it.
TEST_CASE("problems made to be long for pivoting are solved in a few pivots") {
  const int n = GENERATE(2, 3, 5, 8, 12, 16);
  const double below = GENERATE(1.0, 2.0);
  const MatX L = triangle(n, below);
  VecX powers(n);
  for (int i = 0; i < n; ++i) powers[i] = -std::ldexp(1.0, n - 1 - i);
  CAPTURE(n, below);
  for (const VecX& b : {VecX(-VecX::Ones(n)), powers, VecX(-powers)}) {
    const Outcome outcome = holdToExact(pushing(L * L.transpose(), b));
    CHECK(outcome.solvable);
    CHECK(outcome.report.pivots <= 6 * n);
  }
}

// Oracle: rationals. The circulant matrices on which least-ratio rules go round in circles
// (Murty 1988, §2.3.1; Cottle, Pang & Stone 1992, §4.2) made symmetric as M Mᵀ and M + Mᵀ, with
// all |b| equal so that every ratio ties.
TEST_CASE("ties everywhere do not make pivoting go round in circles") {
  const int n = GENERATE(3, 4, 5, 7, 12);
  MatX M = MatX::Identity(n, n);
  for (int i = 0; i < n; ++i) M(i, (i + 1) % n) = 2.0;
  const MatX ring = MatX::Identity(n, n) * 4.0 + M + M.transpose();
  CAPTURE(n);
  for (const MatX& A : {MatX(M * M.transpose()), ring, MatX(MatX::Ones(n, n))})
    for (double sign : {-1.0, 0.0, 1.0}) {
      const Outcome outcome = holdToExact(pushing(A, VecX::Constant(n, sign)));
      CHECK(outcome.solvable);
      CHECK(outcome.report.pivots <= 6 * n);
    }
}

// Oracle: rationals, and the closed form that nothing moves. 4 to 12 points of one face: rank 3.
TEST_CASE("a box on many points, doubled or not, stays where it is under any even load") {
  const int points = GENERATE(4, 6, 12);
  const double tilt = GENERATE(0.0, 0.25, 0.5);  // of the load, towards an edge: 0.5 is the limit
  MatX G(points, 3);
  for (int i = 0; i < points; ++i) G.row(i) << 1.0, i % 2 ? 1.0 : -1.0, i / 2 % 2 ? 1.0 : -1.0;
  const Lcp lcp = pushing(G * G.transpose(), -G * Vec3(1.0, 2.0 * tilt, 0.0));
  CHECK(holdToExact(lcp).error < 1e-14);
  VecX f;
  solveLcp(lcp.A, lcp.b, lcp.lo, lcp.hi, f);
  CHECK((lcp.A * f + lcp.b).lpNorm<Eigen::Infinity>() < 1e-14);
}

// Oracle: rationals. Two rows that want different things of one motion, in every mixture of kinds.
TEST_CASE("inconsistent rows have no answer, redundant ones have one") {
  const double wish = GENERATE(-1.0, 0.0, 1.0, 3.0);
  const double low = GENERATE(-kInfinity, 0.0), other = GENERATE(-kInfinity, 0.0);
  const double side = GENERATE(1.0, -1.0);
  const int copies = GENERATE(1, 3);
  MatX G(2 + copies, 2);
  G << 1.0, 2.0, MatX::Constant(copies, 1, 1.0), MatX::Constant(copies, 1, 2.0), 3.0, 1.0;
  G.row(1) *= side;
  Lcp lcp = pushing(G * G.transpose(), VecX::Constant(2 + copies, -1.0));
  lcp.b[1] = wish;
  lcp.lo[0] = low;
  lcp.lo[1] = other;
  CAPTURE(wish, low, other, side, copies);
  holdToExact(lcp);
}

// Oracle: rationals on the rows of a whole problem, for every solver. v is unique without friction.
// Measured 9e-12 of the largest speed; allowed 1e-9 where masses are of one size.
TEST_CASE("without friction every solver moves the bodies as exact arithmetic does", "[figures]") {
  std::map<std::string, double> worst;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    const Problem problem = randomContacts(seed, Rubbing::None);
    double lightest = 0.0, heaviest = kInfinity, speed = 0.0;
    for (double inverse : problem.invM) {
      lightest = std::max(lightest, inverse);
      if (inverse > 0.0) heaviest = std::min(heaviest, inverse);
    }
    if (lightest > 20.0 * heaviest) continue;
    const std::optional<std::vector<Vec6>> exact = exactMotion(problem);
    REQUIRE(exact);
    for (const Vec6& twist : problem.vStar)
      speed = std::max(speed, twist.lpNorm<Eigen::Infinity>());
    for (const Solver& solver : solvers()) {
      Solution solution;
      const SolveReport report = solver.solve(problem, {}, solution);
      CAPTURE(solver.name, seed, report.residual, report.iterations);
      CHECK(report.status == SolveStatus::Solved);
      const double error = worstDifference(solution.v, *exact) / std::max(speed, 1e-3);
      CHECK(error < 1e-9);
      double& most = worst[std::string(solver.name)];
      most = std::max(most, error);
    }
  }
  for (const auto& [name, error] : worst) WARN(name << ": worst v " << error);
}

// Oracle: rationals. A cube between the floor and a ceiling that comes down: nothing gives way.
// Sweeps push harder for ever, until rounding of so large a λ would excuse any residual.
TEST_CASE("a cube in a closing press has no answer, in a resting one it has") {
  const double closing = GENERATE(0.0, 0.5);
  Problem problem = tower({2.0}, 0.0);
  for (double x : {-0.5, 0.5})
    addContact(problem, 1, 0, Vec3(x, 0.5, 0.0), Vec3(x, 1.5, 0.0), 0.0, -Vec3::UnitY());
  for (std::size_t i = 4; i < 6; ++i) problem.rows[i].bias = -closing;
  const std::optional<std::vector<Vec6>> exact = exactMotion(problem);
  CHECK(exact.has_value() == (closing == 0.0));
  for (const Solver& solver : solvers()) {
    Solution solution;
    const SolveReport report = solver.solve(problem, {}, solution);
    CAPTURE(solver.name, closing);
    if (exact || solver.name != "pgs")
      CHECK((report.status == SolveStatus::Solved) == exact.has_value());
    if (exact) CHECK(worstDifference(solution.v, *exact) < 1e-11);
    for (double force : solution.lambda) CHECK(std::isfinite(force));
    if (solver.name == "pivoting" && !exact) CHECK(report.status == SolveStatus::Infeasible);
  }
}
