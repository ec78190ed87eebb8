// Every solver of the table on random contact problems, and what its answers are worth.
#include "tests/problem/random_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "sim/problem/solvers.h"
#include "tests/catch.h"
#include "tests/problem/check.h"

using namespace tumble;
using namespace tumble::test;

namespace {

constexpr double kTolerance = 1e-12;  ///< asked of the solvers
constexpr double kGoal = 1e-8;        ///< what counts as solved
constexpr double kRounding = 4.0;     ///< times Worth::rounding: as good as doubles let it be
constexpr double kExcuse = 1e-4;      ///< the most that rounding may excuse: it grows with λ

/// What a solver is held to: how many problems it gets and what share it must solve to kGoal, or as
/// far as rounding lets it. A solver that is not named here takes the last row.
struct Demand {
  std::string_view solver;
  int quick, full;
  int maxIterations;
  double share;
  int overflows = 0;       ///< known to end in NaN, of the full count
  double balance = 1e-13;  ///< of what is called solved
};
constexpr std::array kDemands = {
    Demand{"pivoting", 300, 20000, 20000, 0.85},
    Demand{"pgs", 300, 10000, 2000, 0.8, 1},  // grows for ever on problem 971
    Demand{"admm", 300, 10000, 20000, 0.85},
    // Its v is that of its own steps, not of λ, and 99.9 % are asked of the long test alone.
    Demand{"newton", 3000, 100000, 20000, 0.999, 0, 1e300},
    Demand{"", 300, 10000, 20000, 0.0},
};

const Demand& demandOf(std::string_view solver) {
  for (const Demand& demand : kDemands)
    if (demand.solver == solver) return demand;
  return kDemands.back();
}

/// What became of all problems that one solver was given.
struct Tally {
  static constexpr int kLeast = -17;  ///< decade of the first bin; the last one is 1 and above

  int count = 0, solved = 0, solvedOrRounding = 0;
  std::array<int, 3> statuses = {};
  std::array<int, 18> decades = {};
  int iterations = 0, notFinite = 0;
  double balance = 0.0;
  std::string overflown, untrue, unsolved;  ///< seeds, the first few

  void add(std::uint64_t seed, const SolveReport& report, const Worth& worth);
};

void note(std::string& seeds, std::uint64_t seed) {
  if (seeds.size() < 100) seeds += std::to_string(seed) + " ";
}

void Tally::add(std::uint64_t seed, const SolveReport& report, const Worth& worth) {
  ++count;
  ++statuses[static_cast<std::size_t>(report.status)];
  iterations = std::max(iterations, report.iterations);
  if (!worth.finite || !std::isfinite(report.residual)) {
    ++notFinite;
    note(overflown, seed);
    return;
  }
  const double decade = worth.residual > 0.0 ? std::floor(std::log10(worth.residual)) : kLeast;
  const double bin = std::clamp(decade - kLeast, 0.0, static_cast<double>(decades.size() - 1));
  ++decades[static_cast<std::size_t>(bin)];
  const double allowed = std::min(kRounding * worth.rounding, kExcuse);
  solved += worth.residual <= kGoal;
  const bool good = worth.residual <= std::max(kGoal, allowed);
  solvedOrRounding += good;
  if (!good) note(unsolved, seed);
  const bool claim = report.status == SolveStatus::Solved;
  if (claim) balance = std::max(balance, worth.balance);
  if (claim && worth.residual > std::max(10.0 * kTolerance, allowed)) note(untrue, seed);
}

Tally tally(const Solver& solver, int count, int maxIterations) {
  Tally tally;
  for (int k = 0; k < count; ++k) {
    const std::uint64_t seed = static_cast<std::uint64_t>(k);
    const Problem problem = randomContacts(seed, Rubbing::Coulomb);
    Solution solution;
    const SolveReport report = solver.solve(problem, {kTolerance, maxIterations}, solution);
    tally.add(seed, report, worthOf(problem, solution));
  }
  return tally;
}

std::string percent(int part, int whole) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", 100.0 * part / whole);
  return text;
}

/// Three lines of at most 78 characters each.
void print(std::string_view solver, const Tally& tally) {
  const std::string name(solver);
  char text[200];
  std::snprintf(text, sizeof text, "%s: %.3f %% of %d to 1e-8 (%.3f %% or to rounding)",
                name.c_str(), 100.0 * tally.solved / tally.count, tally.count,
                100.0 * tally.solvedOrRounding / tally.count);
  WARN(std::string(text));
  std::snprintf(text, sizeof text,
                "%s: says solved %s %%, not %s %%, none %s %%; <= %d it., balance %.0e",
                name.c_str(), percent(tally.statuses[0], tally.count).c_str(),
                percent(tally.statuses[1], tally.count).c_str(),
                percent(tally.statuses[2], tally.count).c_str(), tally.iterations, tally.balance);
  WARN(std::string(text));
  std::string line = name + " 1e-17, -16 ... 1:";
  for (int bin : tally.decades) line += " " + std::to_string(bin);
  WARN(line);
}

/// Oracle: the conditions of problem.h, worked out in long double.
void hold(const Solver& solver, const Tally& tally, double share, int overflows = 0) {
  CAPTURE(std::string(solver.name), tally.overflown, tally.untrue, tally.unsolved);
  CHECK(tally.notFinite <= overflows);
  CHECK(tally.untrue.empty());
  CHECK(tally.balance < demandOf(solver.name).balance);
  CHECK(tally.solvedOrRounding >= share * tally.count);
}

}  // namespace

TEST_CASE("random contacts: every solver is finite, and what it calls solved is solved") {
  for (const Solver& solver : solvers()) {
    const Demand& demand = demandOf(solver.name);
    hold(solver, tally(solver, demand.quick, demand.maxIterations), std::min(demand.share, 0.8));
  }
}

TEST_CASE("random contacts: the share that each solver solves", "[long][figures]") {
  for (const Solver& solver : solvers()) {
    const Demand& demand = demandOf(solver.name);
    const Tally result = tally(solver, demand.full, demand.maxIterations);
    print(solver.name, result);
    hold(solver, result, demand.share, demand.overflows);
  }
}

// Oracle: the residual, of v from λ alone. Sums of a hundred mixed steps in place of J v are off by
// 1e-12 to 1e-10 of the scale, which no further iteration takes away. Measured: 5e-14 at most,
// allowed 1e-12.
TEST_CASE("admm goes to rounding, however many steps it takes there") {
  const std::uint64_t seed = GENERATE(14, 260, 427, 481);
  const Problem problem = randomContacts(seed, Rubbing::None);
  Solution solution;
  const SolveReport report = solveAdmm(problem, {kTolerance, 20000}, solution);
  CAPTURE(seed, report.iterations, report.residual);
  CHECK(report.status == SolveStatus::Solved);
  CHECK(report.iterations > 50);
}

TEST_CASE("random contacts are what they say: finite, many kinds, equal at every call") {
  int redundant = 0, joints = 0, frictionless = 0, immovable = 0, wide = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const Problem problem = randomContacts(seed, Rubbing::Coulomb);
    const Problem again = randomContacts(seed, Rubbing::Coulomb);
    int contacts = 0, movable = 0, joint = 0, smooth = 0;
    double lightest = 0.0, heaviest = 1e300;
    for (const Cone& cone : problem.cones) {
      contacts += cone.kind != ConeKind::Equality;
      joint += cone.kind == ConeKind::Equality;
      smooth += cone.kind == ConeKind::Push;
    }
    for (double inverse : problem.invM) {
      movable += inverse > 0.0;
      lightest = std::max(lightest, inverse);
      if (inverse > 0.0) heaviest = std::min(heaviest, inverse);
    }
    for (std::size_t i = 0; i < problem.rows.size(); ++i) {
      const Row &row = problem.rows[i], &other = again.rows[i];
      REQUIRE((row.linear.allFinite() && row.angularA.allFinite() && row.angularB.allFinite()));
      REQUIRE((row.linear == other.linear && row.angularA == other.angularA));
      REQUIRE((row.a == other.a && row.b == other.b && row.bias == other.bias));
    }
    REQUIRE(contacts >= 1);
    REQUIRE(contacts <= 24);
    REQUIRE(movable >= 1);
    redundant += static_cast<int>(problem.rows.size()) > 6 * movable;
    joints += joint > 0;
    frictionless += smooth > 0;
    immovable += movable < static_cast<int>(problem.invM.size());
    wide += lightest > 1e6 * heaviest;
  }
  CHECK(redundant > 500);
  CHECK(joints > 300);
  CHECK(frictionless > 300);
  CHECK(immovable > 1000);
  CHECK(wide > 100);
}
