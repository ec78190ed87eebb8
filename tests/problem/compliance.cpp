// Rows that yield as springs do, among contacts, by every solver.
#include "tests/catch.h"

#include "sim/problem/problem.h"

using namespace tumble;

namespace {

/// A cube of 2 kg on the ground and one of 3 kg beside it in the air, both falling at 1 m/s, and a
/// compliant row between them along y. The ground is body 0.
Problem twoBlocks(double compliance) {
  Problem problem;
  problem.invM = {0.0, 1.0 / 2.0, 1.0 / 3.0};
  problem.Iinv.assign(3, Mat3::Zero());
  problem.vStar.assign(3, Vec6::Zero());
  problem.vStar[1][1] = problem.vStar[2][1] = -1.0;
  problem.rows.push_back({.a = 1, .b = 0, .linear = Vec3::UnitY()});
  problem.rows.push_back(
      {.a = 2, .b = 1, .linear = Vec3::UnitY(), .bias = 0.25, .compliance = compliance});
  problem.cones = {{.kind = ConeKind::Push, .row = 0}, {.kind = ConeKind::Equality, .row = 1}};
  return problem;
}

}  // namespace

// Oracle: closed form. The lower block stays on the ground, so v2 + 1/4 + C λ = 0 with
// v2 = −1 + λ/3:  λ = (3/4)/(1/3 + C), and the ground gives 2 + λ. Measured 2e-16, allowed 1e-11.
TEST_CASE("a compliant row shares its load with a contact as solved by hand, by every solver") {
  for (const Solver& solver : solvers()) {
    for (const double compliance : {0.0, 1e-9, 0.01, 1.0, 1e6}) {
      INFO(solver.name << ", compliance " << compliance);
      const Problem problem = twoBlocks(compliance);
      Solution solution;
      const SolveReport report = solver.solve(problem, {}, solution);
      CHECK(report.status == SolveStatus::Solved);
      CHECK(report.residual <= 1e-12);
      const double lambda = 0.75 / (1.0 / 3.0 + compliance);
      CHECK(solution.lambda[1] == Approx(lambda).epsilon(1e-11));
      CHECK(solution.lambda[0] == Approx(2.0 + lambda).epsilon(1e-11));
      CHECK(solution.v[2][1] == Approx(-1.0 + lambda / 3.0).margin(1e-11));
    }
  }
}

// Oracle: closed form,  λ = −(vStar + bias)/(1/m + C)  of one body alone. Measured 1e-16.
TEST_CASE("a compliant row alone is a quotient, by every solver") {
  Problem problem;
  problem.invM = {0.0, 0.5};
  problem.Iinv.assign(2, Mat3::Zero());
  problem.vStar.assign(2, Vec6::Zero());
  problem.vStar[1][0] = 3.0;
  problem.rows.push_back(
      {.a = 1, .b = 0, .linear = Vec3::UnitX(), .bias = -1.0, .compliance = 0.75});
  problem.cones = {{.kind = ConeKind::Equality, .row = 0}};
  for (const Solver& solver : solvers()) {
    INFO(solver.name);
    Solution solution;
    CHECK(solver.solve(problem, {}, solution).status == SolveStatus::Solved);
    CHECK(solution.lambda[0] == Approx(-2.0 / 1.25).epsilon(1e-12));
  }
}
