// One contact alone, against the same contact beside another that opens.
#include "sim/problem/single.h"

#include <algorithm>

#include "tests/catch.h"
#include "tests/problem/problems.h"

using namespace tumble;

namespace {

/// A cube of any mass meets an immovable one, or one that moves, at an arm of its own.
Problem blow(test::Draw& draw) {
  const auto vector = [&](double size) {
    const double x = draw(-size, size), y = draw(-size, size), z = draw(-size, size);
    return Vec3(x, y, z);
  };
  Problem problem;
  const double other = draw(0.0, 1.0) < 0.5 ? 0.0 : draw(0.1, 10.0);
  test::addCube(problem, other, 1.0, Vec3::Zero());
  test::addCube(problem, draw(0.1, 10.0), 1.0, vector(1.0), vector(3.0));
  const double mu = std::max(0.0, draw(-0.2, 1.0));
  test::addContact(problem, 1, 0, vector(0.7), vector(0.7), mu);
  return problem;
}

}  // namespace

// Oracle: another method. With a second contact that opens the general method solves it. Both are
// held to 1e-12; velocities differ by less than 1e-10, measured; allowed 1e-8. Of 2,000 problems
// all are solved alone; allowed 10 that are not.
TEST_CASE("one contact alone is solved as it is beside another") {
  const Solver& newton = *findSolver("newton");
  test::Draw draw(11);
  int alone = 0;
  double worst = 0.0;
  for (int k = 0; k < 2000; ++k) {
    Problem problem = blow(draw);
    Solution single, beside;
    const auto report = solveSingle(problem, 1e-12, single);
    if (!report) continue;
    ++alone;
    CHECK(report->residual <= 1e-12);
    CHECK(report->balance == 0.0);
    const int away = test::addCube(problem, 1.0, 1.0, Vec3::UnitY());
    test::addContact(problem, away, 0, Vec3::Zero(), Vec3::Zero(), 0.0);
    newton.solve(problem, {.tolerance = 1e-12}, beside);
    for (int body : {0, 1}) worst = std::max(worst, (single.v[body] - beside.v[body]).norm());
  }
  CAPTURE(alone, worst);
  CHECK(alone >= 1990);
  CHECK(worst < 1e-8);
}

TEST_CASE("what is not one contact is left to others") {
  Solution untouched;
  CHECK_FALSE(solveSingle(test::tower({1.0}, 0.5), 1e-12, untouched));
  Problem bond;
  test::addCube(bond, 1.0, 1.0, Vec3::UnitX());
  test::addCube(bond, 0.0, 1.0, Vec3::Zero());
  bond.cones.push_back({ConeKind::Equality, 0, 0.0});
  bond.rows.push_back(test::pointRow(0, 1, Vec3::Zero(), Vec3::Zero(), Vec3::UnitX()));
  CHECK_FALSE(solveSingle(bond, 1e-12, untouched));
  CHECK(untouched.v.empty());
}
