// Problems whose mass matrix has blocks off its diagonal: points that something bends joins.
#include <Eigen/Dense>
#include <vector>

#include "sim/problem/nodes.h"
#include "sim/problem/point_contacts.h"
#include "tests/catch.h"
#include "tests/problem/check.h"
#include "tests/problem/problems.h"

using namespace tumble;
using namespace tumble::test;

namespace {

/// A point of mass [kg].
int addPoint(Problem& problem, double mass, const Vec3& v) {
  problem.invM.push_back(1.0 / mass);
  problem.Iinv.push_back(Mat3::Zero());
  Vec6 twist = Vec6::Zero();
  twist.head<3>() = v;
  problem.vStar.push_back(twist);
  return static_cast<int>(problem.invM.size()) - 1;
}

/// A net of points under a block that moves, above a floor; every point may touch both.
Problem net(std::uint64_t seed, int points, bool block, bool rubs) {
  Draw draw(seed);
  Problem problem;
  addCube(problem, 0.0, 1.0, Vec3::Zero());
  if (block) addCube(problem, 50.0, 1.0, Vec3(0.3, -2.0, 0.1), Vec3(0.2, 1.0, -0.3));
  for (int k = 0; k < points; ++k) {
    const double vx = draw(-1.0, 1.0), vy = draw(-2.0, 0.5), vz = draw(-1.0, 1.0);
    const int point = addPoint(problem, draw(0.5, 2.0), Vec3(vx, vy, vz));
    addContact(problem, point, 0, Vec3::Zero(), Vec3::Zero(), rubs ? 0.4 : 0.0);
    const Vec3 arm(draw(-0.5, 0.5), -0.5, draw(-0.5, 0.5));
    if (block && k % 2 == 0) addContact(problem, 1, point, arm, Vec3::Zero(), rubs ? 0.3 : 0.0);
  }
  return problem;
}

struct SpringOf {
  int a, b;
  Vec3 along;
  double stiff, bias;
};

std::vector<SpringOf> springsOf(const Problem& problem, std::uint64_t seed, int first) {
  Draw draw(seed + 100);
  std::vector<SpringOf> springs;
  const int last = static_cast<int>(problem.invM.size()) - 1;
  for (int i = first; i <= last; ++i)
    for (int j = i + 1; j <= std::min(last, i + 2); ++j) {
      const double x = draw(-1.0, 1.0), y = draw(-1.0, 1.0), z = draw(-1.0, 1.0);
      const double stiff = draw(1.0, 200.0);
      springs.push_back({i, j, Vec3(x, y, z).normalized(), stiff, draw(-0.5, 0.5)});
    }
  return springs;
}

/// The same springs as rows that yield:  λ = −stiff (u + bias).
void addRows(Problem& problem, const std::vector<SpringOf>& springs) {
  for (const SpringOf& s : springs) {
    const int row = static_cast<int>(problem.rows.size());
    problem.cones.push_back({ConeKind::Equality, row, 0.0});
    problem.rows.push_back(
        {.a = s.a, .b = s.b, .linear = s.along, .bias = s.bias, .compliance = 1.0 / s.stiff});
  }
}

/// The same springs as couplings, with vStar what they make of the free motion.
void addCouplings(Problem& problem, const std::vector<SpringOf>& springs) {
  const int n = static_cast<int>(problem.invM.size());
  MatX A = MatX::Zero(3 * n, 3 * n);
  VecX b = VecX::Zero(3 * n);
  for (int i = 0; i < n; ++i) {
    const double mass = problem.invM[i] > 0.0 ? 1.0 / problem.invM[i] : 1.0;
    A.block<3, 3>(3 * i, 3 * i).diagonal().setConstant(mass);
    b.segment<3>(3 * i) = mass * problem.vStar[i].head<3>();
  }
  std::vector<Mat3> own(n, Mat3::Zero());
  for (const SpringOf& s : springs) {
    const Mat3 K = s.stiff * s.along * s.along.transpose();
    own[s.a] += K;
    own[s.b] += K;
    problem.couplings.push_back({s.a, s.b, -K});
    b.segment<3>(3 * s.a) -= s.stiff * s.bias * s.along;
    b.segment<3>(3 * s.b) += s.stiff * s.bias * s.along;
    A.block<3, 3>(3 * s.a, 3 * s.b) -= K;
    A.block<3, 3>(3 * s.b, 3 * s.a) -= K;
  }
  for (int i = 0; i < n; ++i) {
    if (own[i].isZero(0.0)) continue;
    problem.couplings.push_back({i, i, own[i]});
    A.block<3, 3>(3 * i, 3 * i) += own[i];
  }
  const VecX star = A.ldlt().solve(b);
  for (int i = 0; i < n; ++i) problem.vStar[i].head<3>() = star.segment<3>(3 * i);
}

}  // namespace

// Oracle: two ways. A spring that is a coupling and one that is a row which yields are the same
// problem. Under a block with friction several motions obey Coulomb's law: there each answer is
// held to its residual alone. Allowed 1e-9: conditioning times the tolerance.
TEST_CASE("points coupled by springs move as points whose springs are rows") {
  const bool block = GENERATE(false, true), rubs = GENERATE(false, true);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Problem rows = net(seed, 8, block, rubs), coupled = rows;
    const auto springs = springsOf(rows, seed, block ? 2 : 1);
    addRows(rows, springs);
    addCouplings(coupled, springs);
    Solution a, b;
    const Solver& newton = *findSolver("newton");
    CAPTURE(seed, block, rubs);
    CHECK(newton.solve(rows, {}, a).status == SolveStatus::Solved);
    const SolveReport report = newton.solve(coupled, {}, b);
    CHECK(report.status == SolveStatus::Solved);
    CHECK(report.balance <= 1e-12);
    CHECK(naturalResidual(coupled, b) <= 1e-11);
    for (std::size_t i = 0; i < a.v.size() && !(block && rubs); ++i)
      CHECK((a.v[i] - b.v[i]).lpNorm<Eigen::Infinity>() <= 1e-9);
    CHECK(islands(coupled).size() == 1);
  }
}

namespace {

/// The largest entry [N s] of A (v − vStar) − Jᵀ λ of bodies that move.
double openBalance(const Problem& problem, const Solution& solution) {
  std::vector<Vec3> open(problem.invM.size(), Vec3::Zero());
  const auto change = [&](int i) { return Vec3((solution.v[i] - problem.vStar[i]).head<3>()); };
  for (const Coupling& c : problem.couplings) {
    open[c.a] += c.block * change(c.b);
    if (c.a != c.b) open[c.b] += c.block.transpose() * change(c.a);
  }
  for (std::size_t r = 0; r < problem.rows.size(); ++r) {
    open[problem.rows[r].a] -= solution.lambda[r] * problem.rows[r].linear;
    open[problem.rows[r].b] += solution.lambda[r] * problem.rows[r].linear;
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (problem.invM[i] == 0.0) continue;
    open[i] += change(static_cast<int>(i)) / problem.invM[i];
    worst = std::max(worst, open[i].lpNorm<Eigen::Infinity>());
  }
  return worst;
}

}  // namespace

// Oracle: two ways. Swept until nothing changes, points that touch what does not move have the
// velocities that Newton's method gives them. With friction several motions may obey Coulomb's law:
// there the answer is held to its cones and its balance. A sweep leaves nothing in the cones,
// however early it ends. Allowed 1e-9: conditioning times the last change.
TEST_CASE("sweeps from point to point end where Newton's method does") {
  const bool rubs = GENERATE(false, true);
  int solved = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Problem problem = net(seed, 40, false, rubs);
    addCouplings(problem, springsOf(problem, seed, 1));
    std::vector<Vec3> side(problem.invM.size(), Vec3::Zero());
    for (std::size_t i = 1; i < side.size(); ++i)
      side[i] = problem.vStar[i].head<3>() / problem.invM[i];
    for (const Coupling& c : problem.couplings) {
      side[c.a] += c.block * problem.vStar[c.b].head<3>();
      if (c.a != c.b) side[c.b] += c.block.transpose() * problem.vStar[c.a].head<3>();
    }
    CAPTURE(seed, rubs);
    Solution exact, swept, rough;
    CHECK(findSolver("newton")->solve(problem, {}, exact).status == SolveStatus::Solved);
    swept.v = rough.v = problem.vStar;
    const SolveReport report = sweepNodes(problem, side, {.enough = 1e-12, .most = 2000}, swept);
    if (report.status == SolveStatus::Solved) ++solved;
    for (std::size_t i = 0; i < side.size() && !rubs; ++i)
      CHECK((exact.v[i] - swept.v[i]).lpNorm<Eigen::Infinity>() <= 1e-9);
    CHECK(naturalResidual(problem, swept) <= 1e-13);
    if (report.status == SolveStatus::Solved) CHECK(openBalance(problem, swept) <= 1e-9);
    const SolveReport early = sweepNodes(problem, side, {.enough = 0.0, .most = 3}, rough);
    CHECK(early.status == SolveStatus::NotConverged);
    CHECK(early.iterations == 3);
    CHECK(naturalResidual(problem, rough) <= 1e-13);
  }
  CHECK(solved >=
        (rubs ? 19 : 20));  // one goes to and fro between sticking and sliding, and says so
}

namespace {

/// A level square sheet of n × n points, one spring apart, that comes down on a floor and slides:
/// stiff along itself, softer across, the more its springs lean.
Problem slidingSheet(int n, double mu, double stiff, double lean) {
  Draw draw(7);
  Problem problem;
  addCube(problem, 0.0, 1.0, Vec3::Zero());
  std::vector<SpringOf> springs;
  for (int i = 0; i < n * n; ++i) {
    const double fall = draw(-1.0, 0.3), along = draw(-0.1, 1.0);
    const int point = addPoint(problem, 0.01, Vec3(along, fall, 0.2));
    addContact(problem, point, 0, Vec3::Zero(), Vec3::Zero(), mu);
    const auto tie = [&](int other, const Vec3& way) {
      springs.push_back({other, point, (way + lean * Vec3::UnitY()).normalized(), stiff, 0.0});
    };
    if (i % n > 0) tie(point - 1, Vec3::UnitX());
    if (i >= n) tie(point - n, Vec3::UnitZ());
  }
  addCouplings(problem, springs);
  return problem;
}

}  // namespace

TEST_CASE("contacts of single points are solved by few factors") {
  const bool rubs = GENERATE(false, true);
  const Problem problem =
      rubs ? slidingSheet(24, 0.3, 50.0, 0.1) : slidingSheet(24, 0.0, 50.0, 0.5);
  Solution answer;
  const auto report = solvePointContacts(problem, {}, answer);
  REQUIRE(report);
  CAPTURE(report->iterations, report->residual, report->balance);
  CHECK(report->status == SolveStatus::Solved);
  CHECK(report->iterations <= 6);
  CHECK(naturalResidual(problem, answer) <= 1e-12);
  CHECK(openBalance(problem, answer) <= 1e-12);
}

// Whole steps go to and fro between the same two pieces here for ever.
TEST_CASE("contacts of points whose friction swings with their neighbours' push come to an end") {
  const Problem problem = slidingSheet(24, 0.3, 5.0, 0.5);
  Solution answer;
  const auto report = solvePointContacts(problem, {}, answer);
  REQUIRE(report);
  CHECK(naturalResidual(problem, answer) <= 1e-12);
  CHECK(openBalance(problem, answer) <= 1e-12);
}

TEST_CASE("a point between two solids is left to other solvers") {
  Problem problem = slidingSheet(24, 0.3, 50.0, 0.1);
  addContact(problem, 1, 0, Vec3::Zero(), Vec3::Zero(), 0.3);
  Solution answer;
  CHECK_FALSE(solvePointContacts(problem, {}, answer));
}

TEST_CASE("only solvers that know couplings say so") {
  for (const Solver& solver : solvers()) CHECK(solver.couples == (solver.name == "newton"));
}
