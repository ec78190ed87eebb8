// What each preset of the table promises, on a pile that has just been shaken.
#include "tests/catch.h"
#include "tests/problem/problems.h"

using namespace tumble;
using namespace tumble::test;

namespace {

/// As the preset solves a crowd that moves.
SolveReport solveBy(const SolverPreset& preset, const Problem& problem, Solution& solution) {
  return findSolver(preset.crowdSolver)->solve(problem, preset.crowd, solution);
}

Problem shakenPile() {
  Problem problem = pile(3, 4, 3, true, 0.5, 1.0 / 60.0);
  shake(problem, 0.05, 1);
  return problem;
}

}  // namespace

// Oracle: the definition of the natural map. Measured below 1e-14, as is allowed; balance below
// 1e-12.
TEST_CASE("each preset tells the residual that it leaves, and momentum is balanced") {
  const Problem problem = shakenPile();
  for (const SolverPreset& preset : solverPresets()) {
    Solution solution;
    const SolveReport report = solveBy(preset, problem, solution);
    CAPTURE(preset.name, report.residual, report.iterations);
    CHECK(std::abs(report.residual - naturalResidual(problem, solution)) < 1e-14);
    CHECK(report.balance < 1e-12);
    CHECK(report.iterations <= preset.crowd.maxIterations);
    CHECK((report.status == SolveStatus::Solved) == (report.residual <= preset.crowd.tolerance));
  }
}

// Oracle: counts and residuals that the table names. Measured: residuals of 6.8e-4 by "balanced",
// whose sweeps are spent, and 0.072 by "fast".
TEST_CASE("the closer a preset is asked to come, the closer it comes, and the longer it takes") {
  const Problem problem = shakenPile();
  Solution exact, balanced, fast;
  const SolveReport best = solveBy(*findSolverPreset("exact"), problem, exact);
  const SolveReport middle = solveBy(*findSolverPreset("balanced"), problem, balanced);
  const SolveReport quick = solveBy(*findSolverPreset("fast"), problem, fast);
  CHECK(best.status == SolveStatus::Solved);
  CHECK(best.residual <= 1e-12);
  CAPTURE(middle.residual, middle.iterations, quick.residual, quick.iterations);
  CHECK(middle.residual <= 1e-3);
  CHECK(middle.iterations == 200);
  CHECK(middle.iterations < best.iterations);
  CHECK(quick.status == SolveStatus::NotConverged);
  CHECK(quick.iterations == 20);
  CHECK(quick.residual > middle.residual);
  CHECK(quick.residual < 0.2);
}
