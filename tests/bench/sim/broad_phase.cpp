// What each broad phase costs a step, against the number of bodies at constant density, and the
// slope of it on logarithmic axes. The constants of sim/collide/broad_phase.cpp and cell_grid.cpp
// come from here.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "app/report/swarm.h"

namespace {

using namespace tumble;

/// Microseconds a step for 10 to `most` bodies, and the slope from 100 on.
void broadPhase(benchmark::State& state, const BroadPhase& row, int most) {
  for (auto _ : state) {
    std::vector<double> counts, times;
    for (const int n : {10, 20, 30, 100, 300, 1000, 3000, 10000, 30000, 100000}) {
      if (n > most) break;
      const double time = timeOfUpdate(row, n);
      state.counters["us_" + std::to_string(n)] = 1e6 * time;
      if (n < 100) continue;
      counts.push_back(n);
      times.push_back(time);
    }
    state.counters["us_1000_5_fast"] = 1e6 * timeOfUpdate(row, 1000, 5);
    state.counters["slope"] = slopeOf(counts, times);
  }
}

}  // namespace

BENCHMARK_CAPTURE(broadPhase, chosen, BroadPhase(), 100000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(broadPhase, all, BroadPhase(broadPhaseRows()[0]), kMostBoxes[0])
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(broadPhase, ends, BroadPhase(broadPhaseRows()[1]), kMostBoxes[1])
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(broadPhase, grid, BroadPhase(broadPhaseRows()[2]), kMostBoxes[2])
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
