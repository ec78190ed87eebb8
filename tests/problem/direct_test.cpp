// What needs no search, against the same beside a contact that opens.
#include "sim/problem/direct.h"

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
    const auto report = solveDirect(problem, {}, single);
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

// Oracle: another method, as above. Chains of up to ten cubes, pinned, with an end of up to a
// million times their mass. Measured 2e-9 of the fastest; allowed 1e-7.
TEST_CASE("equalities alone are solved as they are beside a contact") {
  const Solver& newton = *findSolver("newton");
  test::Draw draw(5);
  double worst = 0.0;
  for (int k = 0; k < 200; ++k) {
    Problem problem;
    test::addCube(problem, 0.0, 1.0, Vec3::Zero());
    const int links = 1 + draw.below(10);
    const double end = std::exp(draw(0.0, std::log(1e6)));
    for (int link = 1; link <= links; ++link) {
      const double x = draw(-1.0, 1.0), y = draw(-1.0, 1.0), z = draw(-1.0, 1.0);
      test::addCube(problem, link < links ? 1.0 : end, 0.3, {x, y, z});
      for (const Vec3& d : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
        problem.cones.push_back({ConeKind::Equality, static_cast<int>(problem.rows.size()), 0.0});
        problem.rows.push_back(
            test::pointRow(link, link - 1, {-0.2, 0.1, 0.0}, {0.2, 0.0, 0.1}, d));
      }
    }
    Solution direct, beside;
    REQUIRE(solveDirect(problem, {}, direct));
    Solution pivoted;
    findSolver("pivoting")->solve(problem, {.tolerance = 1e-12}, pivoted);
    CHECK(pivoted.v == direct.v);
    const int away = test::addCube(problem, 1.0, 1.0, Vec3::UnitY());
    test::addContact(problem, away, 0, Vec3::Zero(), Vec3::Zero(), 0.0);
    newton.solve(problem, {.tolerance = 1e-12}, beside);
    double fastest = 0.0;
    for (const Vec6& v : direct.v) fastest = std::max(fastest, v.norm());
    for (int body = 0; body <= links; ++body)
      worst = std::max(worst, (direct.v[body] - beside.v[body]).norm() / fastest);
  }
  CAPTURE(worst);
  CHECK(worst < 1e-7);
}

// Oracle: symmetry. A row that is told twice is held by two equal forces, the smallest that do.
TEST_CASE("rows that repeat each other share what they hold") {
  Problem twice;
  test::addCube(twice, 2.0, 1.0, Vec3::UnitX());
  test::addCube(twice, 0.0, 1.0, Vec3::Zero());
  for (int row : {0, 1}) {
    twice.cones.push_back({ConeKind::Equality, row, 0.0});
    twice.rows.push_back(test::pointRow(0, 1, Vec3::Zero(), Vec3::Zero(), Vec3::UnitX()));
  }
  Solution shared;
  REQUIRE(solveDirect(twice, {}, shared));
  for (const double lambda : shared.lambda) CHECK(lambda == Approx(-1.0).epsilon(1e-14));
  CHECK(shared.v[0].norm() < 1e-15);
}

TEST_CASE("what needs a search is left to others") {
  Solution untouched;
  CHECK_FALSE(solveDirect(test::tower({1.0}, 0.5), {}, untouched));
  CHECK(untouched.v.empty());
}
