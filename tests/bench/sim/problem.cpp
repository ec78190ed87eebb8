// What a contact problem costs each solver of the table, and how far it gets: towers and piles at
// rest and shaken.
#include "sim/problem/problem.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/problem/problems.h"

namespace {

using namespace tumble;
using namespace tumble::test;

constexpr double kStep = 1.0 / 60.0;    // s
constexpr double kNoise = 0.05;         // m/s
constexpr int kMostForPivoting = 1000;  // rows: dense, O(n³), and never from a start

struct Scene {
  std::string name;
  Problem problem;
};

std::vector<Scene> scenes() {
  std::vector<Scene> list = {
      {"tower of 10", pile(1, 10, 1, false, 0.5, kStep)},
      {"216 boxes aligned", pile(6, 6, 6, false, 0.5, kStep)},
      {"216 boxes in bond", pile(6, 6, 6, true, 0.5, kStep)},
      {"1000 boxes in bond", pile(10, 10, 10, true, 0.5, kStep)},
  };
  const std::size_t count = list.size();
  for (std::size_t i = 0; i < count; ++i) {
    Scene shaken = list[i];
    shaken.name += ", shaken";
    shake(shaken.problem, kNoise, 1);
    list.push_back(shaken);
    list[i].name += ", at rest";
  }
  return list;
}

/// From λ = 0, or from the answer itself: what a step costs where nothing has changed.
void solve(benchmark::State& state, const Solver& solver, const Problem& problem, int maxIterations,
           bool again) {
  const SolveSettings settings{.maxIterations = maxIterations};
  Solution answer;
  SolveReport report = solver.solve(problem, settings, answer);
  if (again && report.status != SolveStatus::Solved) {
    state.SkipWithError("not solved");
    return;
  }
  Solution solution;
  long iterations = 0;
  for (auto _ : state) {
    if (!again) solution.lambda.assign(problem.rows.size(), 0.0);
    if (again) solution.lambda = answer.lambda;
    report = solver.solve(problem, settings, solution);
    iterations += report.iterations;
    benchmark::DoNotOptimize(solution.lambda.data());
  }
  const double contacts = static_cast<double>(problem.cones.size());
  state.counters["contacts"] = contacts;
  state.counters["m/s"] = naturalResidual(problem, solution) * velocityScale(problem);
  state.counters["iterations"] = report.iterations;
  if (solver.name == "pgs" && iterations > 0)
    state.counters["per contact and iteration"] =
        benchmark::Counter(contacts * static_cast<double>(iterations),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void add(const Solver& solver, const Scene& scene, int maxIterations, bool again) {
  std::string name = std::string(solver.name) + ": " + scene.name;
  if (solver.name == "pgs" && !again) name += ", at most " + std::to_string(maxIterations);
  if (again) name += ", again";
  const Problem& problem = scene.problem;
  benchmark::RegisterBenchmark(name.c_str(), [=, &solver](benchmark::State& state) {
    solve(state, solver, problem, maxIterations, again);
  })->Unit(benchmark::kMicrosecond);
}

const int kProblems = [] {
  for (const Scene& scene : scenes())
    for (const Solver& solver : solvers()) {
      if (solver.name == "pivoting" && scene.problem.rows.size() > kMostForPivoting) continue;
      const bool sweeps = solver.name == "pgs";
      const bool rests = scene.problem.vStar[1].head<3>().x() == 0.0;
      if (sweeps)
        for (int most : {10, 100, 1000}) add(solver, scene, most, false);
      else
        add(solver, scene, SolveSettings{}.maxIterations, false);
      if (rests && solver.name != "pivoting")
        add(solver, scene, SolveSettings{}.maxIterations, true);
    }
  return 0;
}();

}  // namespace
