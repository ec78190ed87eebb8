// Contact problems that are hard for their masses, redundancy or thresholds, each with its answer.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "tests/catch.h"
#include "tests/problem/check.h"
#include "tests/problem/problems.h"

using namespace tumble;
using namespace tumble::test;

namespace {

constexpr double kH = 1.0 / 60.0;  // s

/// Whether a solver is expected to solve what sweeps cannot: long chains of unequal masses.
bool direct(const Solver& solver) {
  return solver.name != "pgs";
}

/// Solves, holds the answer to what it claims, and returns whether it claims to be solved.
bool solve(const Solver& solver, const Problem& problem, Solution& solution) {
  const SolveReport report = solver.solve(problem, {}, solution);
  const Worth worth = worthOf(problem, solution);
  CAPTURE(std::string(solver.name), worth.residual, worth.rounding, worth.balance,
          report.iterations);
  REQUIRE(worth.finite);
  CHECK(worth.balance < 1e-14);
  const bool solved = report.status == SolveStatus::Solved;
  if (solved) CHECK(worth.residual < std::max(1e-11, 4.0 * worth.rounding));
  return solved;
}

std::vector<double> powersOfTwo(int n) {
  std::vector<double> masses;
  for (int i = 0; i < n; ++i) masses.push_back(std::ldexp(1.0, i));
  return masses;
}

double fastest(const Solution& solution, std::size_t from = 0) {
  double most = 0.0;
  for (std::size_t i = from; i < solution.v.size(); ++i)
    most = std::max(most, solution.v[i].lpNorm<Eigen::Infinity>());
  return most;
}

/// Each level of a tower at rest carries what stands above it, by "newton" to so much of the load,
/// by the others to 1e-10 or to what rounding leaves of velocities, which is what answers are
/// called solved within; and nothing moves.
void holdTower(const std::vector<double>& masses, double mu, double newton) {
  const Problem problem = tower(masses, mu);
  for (const Solver& solver : solvers()) {
    Solution solution;
    const bool solved = solve(solver, problem, solution);
    CAPTURE(solver.name, masses.size(), mu);
    if (direct(solver)) CHECK(solved);
    if (!solved) continue;
    const double rounding = 4.0 * worthOf(problem, solution).rounding;
    const double allowed = solver.name == "newton" ? newton : std::max(1e-10, rounding);
    double above = 0.0;
    for (std::size_t k = masses.size(); k-- > 0;) {
      above += kG * masses[k];
      CHECK(std::abs(levelForce(problem, solution, static_cast<int>(k)) - above) < allowed * above);
    }
    CHECK(fastest(solution) < allowed * kG * masses.back() / masses.front());
  }
}

/// A cube on a slope whose tangent is `slope`, with gravity turned instead.
Problem onSlope(double slope, double mu) {
  Problem problem = tower({2.0}, mu);
  const double cosine = 1.0 / std::sqrt(1.0 + slope * slope);
  problem.vStar[1].head<3>() = kG * cosine * Vec3(slope, -1.0, 0.0);
  return problem;
}

void addEquality(Problem& problem, const Row& row) {
  problem.cones.push_back({ConeKind::Equality, static_cast<int>(problem.rows.size()), 0.0});
  problem.rows.push_back(row);
}

void addBall(Problem& problem, int a, int b, const Vec3& ra, const Vec3& rb) {
  for (int k = 0; k < 3; ++k) addEquality(problem, pointRow(a, b, ra, rb, Vec3::Unit(k)));
}

void addWeld(Problem& problem, int a, int b, const Vec3& ra, const Vec3& rb) {
  addBall(problem, a, b, ra, rb);
  for (int k = 0; k < 3; ++k)
    addEquality(problem, {a, b, Vec3::Zero(), Vec3::Unit(k), -Vec3::Unit(k), 0.0});
}

}  // namespace

// Oracle: closed form, N_k = g Σ_{j ≥ k} m_j. A cube that sinks at v for rounding takes the whole
// tower with it, v/(g h) of its load: a unit in the last place of λ at the lowest of twenty cubes
// is 2e-10. Measured 0.3 of the rounding, allowed 4 or 1e-10.
TEST_CASE(
    "towers of ten and twenty cubes, each twice as heavy as the one below, carry their load") {
  const double lowest = GENERATE(1.0, 1.1, 1.3, 1.7);
  std::vector<double> masses = powersOfTwo(GENERATE(10, 20));
  for (double& mass : masses) mass *= lowest;
  holdTower(masses, GENERATE(0.0, 0.5), 1e-10);
}

// Oracle: closed form. The light cube's acceleration is a difference of forces that rounds to
// ε M/m of g; answers are called solved within it, and the forces are wrong by as much. Measured
// 3.7 of the rounding over a hundred ratios, allowed 4 or 1e-10.
TEST_CASE("a light cube carries a heavy one") {
  const double light = GENERATE(1.0, 1e-3), ratio = GENERATE(1e3, 1e6, 0x1p30);
  const double more = GENERATE(1.0, 1.2, 1.5, 1.9);
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * more * ratio;
  holdTower({light, more * ratio * light}, GENERATE(0.0, 0.9), std::max(1e-10, rounding));
}

// Oracle: symmetry. The load of a cube on four corners has no unique split; the one that no order
// of contacts prefers is even. Measured 8e-10, allowed 1e-6.
TEST_CASE("a cube on four legs loads them alike, whatever their order") {
  const Problem problem = tower({4.0}, GENERATE(0.0, 0.5));
  for (const Solver& solver : solvers()) {
    if (!direct(solver)) continue;
    Solution solution;
    CHECK(solve(solver, problem, solution));
    CAPTURE(solver.name);
    for (const Cone& cone : problem.cones)
      CHECK(std::abs(solution.lambda[cone.row] - kG) < 1e-6 * kG);
  }
}

// Oracle: closed form. v_t − mu g h along the slip, u_n = 0: a cone without the true law would lift
// the cube at mu |u_t|. Measured 4e-12 of the speed, allowed 1e-11.
TEST_CASE("a cube that slides does not lift") {
  const double mu = GENERATE(0.1, 0.5, 0.9), speed = GENERATE(1.0, 30.0);
  Problem problem = tower({2.0}, mu);  // that cannot tip
  const Vec3 along = Vec3(0.6, 0.0, 0.8);
  problem.vStar[1].head<3>() = speed * along - kG * kH * Vec3::UnitY();
  problem.Iinv[1].setZero();
  for (const Solver& solver : solvers()) {
    Solution solution;
    CHECK(solve(solver, problem, solution));
    CAPTURE(solver.name, mu, speed);
    CHECK(std::abs(solution.v[1][1]) < 1e-11 * speed);
    const Vec3 expected = (speed - mu * kG * kH) * along;
    CHECK((solution.v[1].head<3>() - expected).norm() < 1e-11 * speed);
  }
}

// Oracle: closed form. A wedge of half angle b that hangs between two walls: they carry its weight,
// N = m g/(2 sin b) each if there is no friction.
TEST_CASE("a wedge between two walls stays, whatever its angle") {
  const double angle = GENERATE(0.05, 0.3, 1.0), mu = GENERATE(0.0, 0.2, 1.0);
  Problem problem;
  addCube(problem, 0.0, 1.0, Vec3::Zero());
  addCube(problem, 2.0, 1.0, Vec3(0.0, -kG, 0.0));
  for (double side : {-1.0, 1.0})
    for (double z : {-0.3, 0.3}) {
      const Vec3 n(-side * std::cos(angle), std::sin(angle), 0.0), at(0.3 * side, 0.0, z);
      addContact(problem, 1, 0, at, at, mu, n, Vec3::UnitZ());
    }
  for (const Solver& solver : solvers()) {
    Solution solution;
    CAPTURE(solver.name, angle, mu);
    const bool solved = solve(solver, problem, solution);
    if (solver.name == "newton" && mu > 0.0 && !solved) continue;  // a shortfall that it admits
    CHECK(solved);
    CHECK(fastest(solution) < 1e-10 / std::sin(angle));  // n·v is held to the tolerance
    double lift = 0.0, push = 0.0;
    for (std::size_t i = 0; i < problem.rows.size(); ++i)
      lift += solution.lambda[i] * problem.rows[i].linear.y();
    for (const Cone& cone : problem.cones) push += solution.lambda[cone.row];
    CHECK(std::abs(lift - 2.0 * kG) < 1e-9);
    if (mu == 0.0) CHECK(std::abs(push - 2.0 * kG / std::sin(angle)) < 1e-9 * push);
  }
}

// Oracle: closed form. Jaws of mass mj are pressed by P on both faces of a wedge of mass m and half
// angle b. It stays iff mu ≥ tan b; else it is squeezed out with
//   a = q P/(m + q mj tan b),  q = 2 tan(b − atan mu).
// Bracketed to 1e-9 of mu, where a = 6e-8 m/s². Measured 4e-14, allowed 1e-9 m/s².
TEST_CASE("a wedge between two jaws jams at mu = tan b") {
  const double angle = 0.3, press = 200.0, mass = 2.0, jawMass = 1.0;
  const double part = GENERATE(0.0, 0.5, 1.0 - 1e-6, 1.0 - 1e-9, 1.0 + 1e-9, 1.5);
  const double mu = part * std::tan(angle);
  Problem problem;
  addCube(problem, 0.0, 1.0, Vec3::Zero());
  const int wedge = addCube(problem, mass, 1.0, Vec3::Zero());
  for (double side : {-1.0, 1.0}) {
    const int jaw = addCube(problem, jawMass, 1.0, Vec3(-side * press / jawMass, 0.0, 0.0));
    problem.Iinv[jaw].setZero();
    for (int k : {1, 2})
      addEquality(problem, pointRow(jaw, 0, Vec3::Zero(), Vec3::Zero(), Vec3::Unit(k)));
    const Vec3 n(-side * std::cos(angle), std::sin(angle), 0.0), at(0.3 * side, 0.0, 0.0);
    addContact(problem, wedge, jaw, at, Vec3::Zero(), mu, n, Vec3::UnitZ());
  }
  const double q = part < 1.0 ? 2.0 * std::tan(angle - std::atan(mu)) : 0.0;
  const double expected = q * press / (mass + q * jawMass * std::tan(angle));
  for (const Solver& solver : solvers()) {
    Solution solution;
    CAPTURE(solver.name, part, expected);
    CHECK(solve(solver, problem, solution));
    CHECK(std::abs(solution.v[wedge][1] - expected) < 1e-9);
  }
}

// Oracle: closed form. a = g (sin θ − mu cos θ) or 0, to 1e-9 on both sides of mu = tan θ, where it
// is 4e-9 m/s². Friction that points aside at one corner and back at the next is weaker by the
// square of that angle, and hardly shows in the natural map: sweeps end 2e-8 off. Measured
// 2e-14 elsewhere, allowed 1e-9 m/s².
TEST_CASE("a cube on a slope lets go at mu = tan of the slope to nine digits") {
  const double slope = GENERATE(0.2, 0.5), side = GENERATE(-1.0, 1.0);
  const double mu = slope * (1.0 + 1e-9 * side);
  const double cosine = 1.0 / std::sqrt(1.0 + slope * slope);
  const double expected = side < 0.0 ? kG * cosine * slope * 1e-9 : 0.0;
  const Problem problem = onSlope(slope, mu);
  for (const Solver& solver : solvers()) {
    Solution solution;
    CAPTURE(solver.name, slope, side);
    CHECK(solve(solver, problem, solution));
    CHECK(std::abs(solution.v[1][0] - expected) < (direct(solver) ? 1e-9 : 1e-7));
    CHECK(std::abs(solution.v[1][1]) < 1e-10);
  }
}

// Oracle: closed form. Joint k carries g (M + the links below it); nothing moves. Measured
// 3e-12 of it, allowed 1e-9.
TEST_CASE("a chain of a hundred links carries a thousand times the mass of one") {
  const int links = 100;
  const double end = 1000.0;
  Problem problem;
  addCube(problem, 0.0, 1.0, Vec3::Zero());
  for (int k = 1; k <= links; ++k) {
    addCube(problem, k < links ? 1.0 : end, 1.0, Vec3(0.0, -kG, 0.0));
    addBall(problem, k, k - 1, Vec3(0.0, 0.5, 0.0), Vec3(0.0, -0.5, 0.0));
  }
  for (const Solver& solver : solvers()) {
    Solution solution;
    const bool solved = solve(solver, problem, solution);
    CAPTURE(solver.name);
    if (direct(solver)) CHECK(solved);
    if (!solved) continue;
    CHECK(fastest(solution) < 1e-9 * kG);
    for (int k = 1; k <= links; ++k) {
      const double below = kG * (end + links - k);
      CHECK(std::abs(solution.lambda[3 * (k - 1) + 1] - below) < 1e-9 * below);
    }
  }
}

// Oracle: closed form, one rigid body of all cubes: v = F/(n m) + ω × r, ω = I⁻¹ (r × F). A row of
// cubes glued over and over, and a ring that closes on itself. Measured 2e-13 of 1 m/s, allowed
// 1e-10.
TEST_CASE("bodies glued together many times over move as one") {
  const int copies = GENERATE(1, 3);
  const bool ring = GENERATE(false, true);
  const double mass = 2.0;
  const std::vector<Vec3> places = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};
  const Vec3 kick(1.0, 2.0, 3.0);  // v* of the first cube
  Problem problem;
  for (int k = 0; k < 4; ++k) addCube(problem, mass, 1.0, k == 0 ? kick : Vec3(Vec3::Zero()));
  for (int k = 0; k < (ring ? 4 : 3); ++k) {
    const Vec3 half = 0.5 * (places[(k + 1) % 4] - places[k]);
    for (int copy = 0; copy < copies; ++copy) addWeld(problem, k, (k + 1) % 4, half, -half);
  }
  // Each cube turns with m/6 of its own and m |r|² about the common centre.
  const Vec3 v = kick / 4.0, L = places[0].cross(mass * kick);
  Mat3 inertia = Mat3::Zero();
  for (const Vec3& r : places)
    inertia += mass * (Mat3::Identity() * (1.0 / 6.0 + r.squaredNorm()) - r * r.transpose());
  const Vec3 omega = inertia.inverse() * L;
  for (const Solver& solver : solvers()) {
    Solution solution;
    CAPTURE(solver.name, copies, ring);
    CHECK(solve(solver, problem, solution));
    for (int k = 0; k < 4; ++k) {
      CHECK((solution.v[k].head<3>() - v - omega.cross(places[k])).norm() < 1e-10);
      CHECK((solution.v[k].tail<3>() - omega).norm() < 1e-10);
    }
  }
}
