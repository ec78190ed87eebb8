// What each broad phase costs a step, against the number of bodies at constant density, and the
// slope of it on logarithmic axes. The constants of sim/collide/broad_phase.cpp and cell_grid.cpp
// come from here.
#include "sim/collide/broad_phase.h"

#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace tumble;

/// Boxes with edges of 0.4 to 1.6, 0.24 of them in a unit cube, that bounce about in a cube; a step
/// takes them 1 % of their mean edge on average.
class Swarm {
 public:
  /// @param fast  boxes that move 300 times as fast
  explicit Swarm(int count, int fast = 0) : side_(std::cbrt(count / 0.24)) {
    std::mt19937_64 engine(1);
    const auto vector = [&](double lo, double hi) {
      Vec3 v;
      for (int k = 0; k < 3; ++k)
        v[k] = lo + (hi - lo) * std::ldexp(static_cast<double>(engine() >> 11), -53);
      return v;
    };
    // Of a vector with coordinates in ±1 the mean length is 0.96.
    for (int i = 0; i < count; ++i) {
      const Vec3 half = vector(0.2, 0.8), x = vector(0.0, side_);
      boxes_.push_back({x - half, x + half});
      steps_.push_back((i < fast ? 3.0 : 0.01) / 0.96 * vector(-1.0, 1.0));
    }
  }
  void step() {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const Vec3 x = 0.5 * (boxes_[i].lo + boxes_[i].hi);
      for (int k = 0; k < 3; ++k)
        if ((x[k] < 0.0 && steps_[i][k] < 0.0) || (x[k] > side_ && steps_[i][k] > 0.0))
          steps_[i][k] *= -1.0;
      boxes_[i].lo += steps_[i];
      boxes_[i].hi += steps_[i];
    }
  }
  const std::vector<Aabb>& boxes() const { return boxes_; }

 private:
  double side_;
  std::vector<Aabb> boxes_;
  std::vector<Vec3> steps_;
};

double cpuTime() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What looking at the clock costs [s].
double clockTime() {
  const double start = cpuTime();
  for (int k = 0; k < 1000; ++k) benchmark::DoNotOptimize(cpuTime());
  return (cpuTime() - start) / 1001.0;
}

/// Mean CPU time [s] of an update over many steps, without the steps themselves.
double timeOf(BroadPhase broadPhase, int count, int fast = 0) {
  Swarm swarm(count, fast);
  for (int k = 0; k < 30; ++k) {
    swarm.step();
    broadPhase.update(swarm.boxes());
  }
  const int steps = std::max(60, 200000 / count);
  const double clock = clockTime();
  double spent = 0.0;
  for (int k = 0; k < steps; ++k) {
    swarm.step();
    const double start = cpuTime();
    broadPhase.update(swarm.boxes());
    spent += cpuTime() - start - clock;
  }
  return spent / steps;
}

/// Slope of log y against log x, least squares.
double slopeOf(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double p = std::log(x[k]), q = std::log(y[k]);
    sx += p, sy += q, sxx += p * p, sxy += p * q;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Microseconds a step for 10 to `most` bodies, and the slope from 100 on.
void broadPhase(benchmark::State& state, const BroadPhase& row, int most) {
  for (auto _ : state) {
    std::vector<double> counts, times;
    for (const int n : {10, 20, 30, 100, 300, 1000, 3000, 10000, 30000, 100000}) {
      if (n > most) break;
      const double time = timeOf(row, n);
      state.counters["us_" + std::to_string(n)] = 1e6 * time;
      if (n < 100) continue;
      counts.push_back(n);
      times.push_back(time);
    }
    state.counters["us_1000_5_fast"] = 1e6 * timeOf(row, 1000, 5);
    state.counters["slope"] = slopeOf(counts, times);
  }
}

}  // namespace

BENCHMARK_CAPTURE(broadPhase, chosen, BroadPhase(), 100000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(broadPhase, all, BroadPhase(broadPhaseRows()[0]), 3000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(broadPhase, ends, BroadPhase(broadPhaseRows()[1]), 10000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(broadPhase, grid, BroadPhase(broadPhaseRows()[2]), 100000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
