// The table of solvers on problems with answers in closed form.
#include "tests/catch.h"
#include "tests/problem/problems.h"

using namespace tumble;
using namespace tumble::test;

// Oracle: closed form, N_k = g Σ_{j ≥ k} m_j. Measured 2e-12 (residual 4e-13), allowed 1e-10.
TEST_CASE("each level of a tower of ten equal cubes carries the weight above it") {
  const Problem problem = tower(std::vector<double>(10, 2.0), GENERATE(0.0, 0.5));
  for (const Solver& solver : solvers()) {
    Solution solution;
    const SolveReport report = solveByIslands(solver, problem, {}, solution);
    CAPTURE(solver.name, report.residual, report.iterations);
    CHECK(report.status == SolveStatus::Solved);
    for (int k = 0; k < 10; ++k) {
      const double above = 2.0 * kG * (10 - k);
      CHECK(std::abs(levelForce(problem, solution, k) - above) < 1e-10 * above);
    }
  }
}
