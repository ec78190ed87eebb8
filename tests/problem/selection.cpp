// Which forces, where several hold: those of contact points of one compliance, without a load at
// first, in the limit of none.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "sim/problem/cone.h"
#include "sim/problem/delassus.h"
#include "sim/problem/friction_block.h"
#include "sim/problem/solvers.h"
#include "tests/catch.h"
#include "tests/problem/problems.h"
#include "tests/problem/random_contacts.h"

using namespace tumble;
using namespace tumble::test;

namespace {

constexpr double kStep = 1.0 / 240.0;  // s

/// A box of 6 kg, 0.3 × 0.1 × 0.2 m, on a floor that it touches in points of its lower face, as a
/// step finds it. Body 0 is the floor.
Problem box(const Vec3& v, const Vec3& omega, double mu, const std::vector<Eigen::Vector2d>& at) {
  Problem problem;
  addCube(problem, 0.0, 1.0, Vec3::Zero());
  addCube(problem, 6.0, 1.0, v + Vec3(0.0, -kG * kStep, 0.0), omega);
  problem.Iinv[1] = Vec3(2.0 / 0.05, 2.0 / 0.13, 2.0 / 0.1).asDiagonal();
  for (const auto& p : at)
    addContact(problem, 1, 0, Vec3(p[0], -0.05, p[1]), Vec3(p[0], 0.0, p[1]), mu);
  return problem;
}

std::vector<Eigen::Vector2d> corners() {
  return {{-0.15, -0.1}, {-0.15, 0.1}, {0.15, -0.1}, {0.15, 0.1}};
}

std::vector<Eigen::Vector2d> scattered(int count, std::uint64_t seed) {
  Draw draw(seed);
  std::vector<Eigen::Vector2d> at;
  for (int k = 0; k < count; ++k) {
    const double x = draw(-0.15, 0.15), z = draw(-0.1, 0.1);
    at.emplace_back(x, z);
  }
  return at;
}

Solution solved(const Problem& problem) {
  Solution solution;
  const SolveReport report = solveNewton(problem, {}, solution);
  REQUIRE(report.status == SolveStatus::Solved);
  return solution;
}

/// How far the pressures of points are from a plane over their places, of the largest.
double bent(const Problem& problem, const Solution& solution,
            const std::vector<Eigen::Vector2d>& at) {
  MatX places(at.size(), 3);
  VecX push(at.size());
  for (std::size_t k = 0; k < at.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    places.row(row) << 1.0, at[k][0], at[k][1];
    push[row] = solution.lambda[problem.cones[k].row];
  }
  const VecX plane = places.colPivHouseholderQr().solve(push);
  return (places * plane - push).lpNorm<Eigen::Infinity>() / push.maxCoeff();
}

/// λ of springs of one compliance [1/kg], cone after cone, as solveFrictionBlock has it for a block
/// that is stiffer by that.
VecX bySweeps(const Problem& problem, double compliance) {
  constexpr int kSweeps = 300000;
  const Delassus system = delassus(problem);
  VecX lambda = VecX::Zero(system.b.size());
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (const Cone& cone : problem.cones) {
      const Mat3 W = system.A.block<3, 3>(cone.row, cone.row);
      const Vec3 own = lambda.segment<3>(cone.row);
      const Vec3 c = system.A.middleRows<3>(cone.row) * lambda + system.b.segment<3>(cone.row);
      lambda.segment<3>(cone.row) =
          solveFrictionBlock(W + compliance * Mat3::Identity(), c - W * own, cone.mu, own);
    }
  return lambda;
}

/// The same problem with bodies and cones in another order, turned by R.
struct Permuted {
  Permuted(const Problem& whole, std::uint64_t seed);

  Problem problem;
  std::vector<int> rowOf;  ///< per row of the whole
};

std::vector<int> shuffled(std::size_t count, Draw& draw) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (int i = static_cast<int>(count) - 1; i > 0; --i)
    std::swap(order[static_cast<std::size_t>(i)],
              order[static_cast<std::size_t>(draw.below(i + 1))]);
  return order;
}

Permuted::Permuted(const Problem& whole, std::uint64_t seed) : rowOf(whole.rows.size()) {
  Draw draw(seed);
  const std::vector<int> body = shuffled(whole.invM.size(), draw);
  const double x = draw(-1.0, 1.0), y = draw(-1.0, 1.0), z = draw(-1.0, 1.0);
  const Mat3 R = Eigen::AngleAxisd(2.0, Vec3(x, y, z).normalized()).toRotationMatrix();
  problem.invM.resize(body.size());
  problem.Iinv.resize(body.size());
  problem.vStar.resize(body.size());
  for (std::size_t i = 0; i < body.size(); ++i) {
    const auto to = static_cast<std::size_t>(body[i]);
    problem.invM[to] = whole.invM[i];
    problem.Iinv[to] = R * whole.Iinv[i] * R.transpose();
    problem.vStar[to] << R * whole.vStar[i].head<3>(), R * whole.vStar[i].tail<3>();
  }
  for (const int c : shuffled(whole.cones.size(), draw)) {
    Cone cone = whole.cones[static_cast<std::size_t>(c)];
    const int first = cone.row;
    cone.row = static_cast<int>(problem.rows.size());
    problem.cones.push_back(cone);
    for (int k = 0; k < coneRows(cone.kind); ++k) {
      Row row = whole.rows[static_cast<std::size_t>(first + k)];
      row.a = body[static_cast<std::size_t>(row.a)];
      row.b = body[static_cast<std::size_t>(row.b)];
      for (Vec3* part : {&row.linear, &row.angularA, &row.angularB}) *part = R * *part;
      rowOf[static_cast<std::size_t>(first + k)] = static_cast<int>(problem.rows.size());
      problem.rows.push_back(row);
    }
  }
}

}  // namespace

// Oracle: closed form. λ = −J δ is a plane over the places of one face, whichever way each point
// slips. Measured 3e-11 of the largest, allowed 1e-9; of the forces that
// Newton's method finds first, 0.6.
TEST_CASE("under a box that slides and spins the pressure is linear in place") {
  for (const auto& at : {corners(), scattered(9, 3), scattered(24, 4)}) {
    const Problem problem = box(Vec3(2.0, 0.0, 0.5), Vec3(0.0, 3.0, 0.0), 0.3, at);
    CHECK(bent(problem, solved(problem), at) < 1e-9);
  }
}

// Oracle: closed form. Where all stick, no other λ has a smaller sum of squares: it is orthogonal
// to every λ that balances itself, as two corners that pull at each other do. Measured 2e-13.
TEST_CASE("corners that stick do not pull at each other") {
  const Problem problem = box(Vec3::Zero(), Vec3(0.3, 0.0, 0.0) * kStep, 0.9, corners());
  const Solution solution = solved(problem);
  std::vector<double> lambda = solution.lambda;
  std::vector<Vec6> v(2);
  for (const auto& [i, j, row] : {std::array{0, 2, 1}, std::array{1, 3, 1}, std::array{0, 1, 2}}) {
    // The line between corners i and j is that of this row.
    const double pull = lambda[static_cast<std::size_t>(3 * i + row)] -
                        lambda[static_cast<std::size_t>(3 * j + row)];
    CHECK(std::abs(pull) < 1e-10);
  }
}

// Oracle: springs of compliance ε, ε/2 and ε/4 by another solver; the limit by Richardson, which
// errs by ε³. Some points slide, some stick, and some give all their friction although nothing
// slips. Measured 2e-5 of the largest, allowed 1e-4; of the forces that Newton's method finds
// first, up to 0.95.
TEST_CASE("forces are the limit of springs of vanishing compliance") {
  constexpr double kSoft = 1e-3;  // 1/kg
  for (const Vec3& pull : {Vec3(3.3, 0.0, 0.0), Vec3(2.85, 0.0, 0.5)})
    for (const double turn : {0.0, 18.0}) {
      const Problem problem =
          box(kStep * pull, kStep * Vec3(0.0, turn, 0.0), 0.3, scattered(6, 11));
      const Solution solution = solved(problem);
      const VecX limit = (8.0 * bySweeps(problem, 0.25 * kSoft) -
                          6.0 * bySweeps(problem, 0.5 * kSoft) + bySweeps(problem, kSoft)) /
                         3.0;
      const Eigen::Map<const VecX> lambda(solution.lambda.data(), limit.size());
      CAPTURE(pull.transpose(), turn);
      CHECK((lambda - limit).lpNorm<Eigen::Infinity>() < 1e-4 * limit.maxCoeff());
    }
}

// Oracle: closed form. Springs that nothing presses together do not hold.
TEST_CASE("a box that fits between two walls without clearance falls") {
  Problem problem;
  addCube(problem, 0.0, 1.0, Vec3::Zero());
  addCube(problem, 1.0, 1.0, Vec3(0.0, -kG * kStep, 0.0));
  for (const double side : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5})
        addContact(problem, 1, 0, Vec3(side, y, z), Vec3(side, y, z), 1.0,
                   Vec3(side < 0.0 ? 1.0 : -1.0, 0.0, 0.0), Vec3::UnitY());
  const Solution solution = solved(problem);
  for (const double lambda : solution.lambda) CHECK(std::abs(lambda) < 1e-15);
  CHECK(std::abs(solution.v[1][1] + kG * kStep) < 1e-15);
}

// Oracle: symmetry. λ of 150 random problems, of those that are solved, against the same
// with bodies and cones in another order and turned. Measured 97 % to 1e-8 of the largest.
TEST_CASE("forces depend on no order and no frame") {
  int count = 0, same = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const Problem problem = randomContacts(seed, Rubbing::Coulomb);
    const Permuted other(problem, seed);
    Solution one, two;
    const SolveReport first = solveNewton(problem, {}, one);
    const SolveReport second = solveNewton(other.problem, {}, two);
    if (first.status != SolveStatus::Solved || second.status != SolveStatus::Solved) continue;
    double largest = 0.0, off = 0.0;
    for (std::size_t r = 0; r < one.lambda.size(); ++r) {
      largest = std::max(largest, std::abs(one.lambda[r]));
      off = std::max(
          off, std::abs(one.lambda[r] - two.lambda[static_cast<std::size_t>(other.rowOf[r])]));
    }
    ++count;
    same += off <= 1e-8 * largest;
  }
  CHECK(count > 140);
  CHECK(same >= 0.95 * count);
}

// Oracle: the same problem without a hint. λ that begins with the pulls of another problem, of
// mirrored ones, or of its own. Measured 2e-12 of the largest; its own need three factors at most.
TEST_CASE("forces do not depend on those that are expected") {
  const auto at = scattered(12, 7);
  for (const Vec3& speed : {Vec3(2.0, 0.0, 0.5), Vec3(kStep * 3.1, 0.0, 0.0), Vec3(0.0, 0.0, 0.0)})
    for (const double turn : {0.0, 3.0, kStep * 18.0}) {
      const Problem problem = box(speed, Vec3(0.0, turn, 0.0), 0.3, at);
      const Solution alone = solved(problem);
      const double largest = *std::max_element(alone.lambda.begin(), alone.lambda.end());
      CAPTURE(speed.transpose(), turn);
      const auto offWith = [&](const std::vector<double>& pull, int most) {
        Solution hinted;
        const SolveReport report = solveNewton(problem, {.pull = pull}, hinted);
        CHECK(report.status == SolveStatus::Solved);
        CHECK(report.iterations <= most);
        double off = 0.0;
        for (std::size_t r = 0; r < alone.lambda.size(); ++r)
          off = std::max(off, std::abs(alone.lambda[r] - hinted.lambda[r]));
        return off / largest;
      };
      const Problem near = box(1.05 * speed, Vec3(0.0, 0.9 * turn, 0.0), 0.3, at);
      const Problem mirrored = box(-speed, Vec3(0.0, -turn, 0.0), 0.3, at);
      CHECK(offWith(solved(near).pull, 200) < 1e-9);
      CHECK(offWith(solved(mirrored).pull, 200) < 1e-9);
      if (!alone.pull.empty()) CHECK(offWith(alone.pull, 3) < 1e-9);
    }
}
