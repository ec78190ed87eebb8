// What bodies that fall into a tray cost by `stepping`, and how deep they ever overlap.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include "sim/problem/problem.h"
#include "tests/world/tray.h"

namespace {

using namespace tumble;

struct Fall {
  const char *bodies, *preset;
  int count, rate;  ///< bodies; steps per second
  double duration;  ///< [s]
  int trays;        ///< the cost of one alone says little: heaps are chaotic
};

std::string titleOf(const Fall& row) {
  return "tray: " + std::to_string(row.count) + ' ' + row.bodies + ", " + row.preset + ", " +
         std::to_string(row.rate) + "/s";
}

/// `cost`: CPU seconds for a simulated second, the mean of trays whose gravity differs; `overlap`
/// [m] and `lifted`, of the energy at the start: the largest.
void fall(benchmark::State& state, const Fall& row) {
  const bool balls = row.bodies == std::string_view("balls");
  WorldDef def = scenes::tray(balls ? Shape(Sphere{0.15}) : scenes::kBrick, row.count);
  def.duration = row.duration;
  def.stepping.step = 1.0 / row.rate;
  def.stepping.take(*findSolverPreset(row.preset));
  constexpr double kApart = 1e-3;  // of g, from tray to tray
  double overlap = 0.0, lifted = 0.0;
  for (auto _ : state) {
    for (int k = 0; k < row.trays; ++k) {
      WorldDef tray = def;
      tray.gravity *= 1.0 + kApart * k;
      World world(tray);
      world.advance(tray.duration);
      const Certificate& books = world.report().certificate;
      overlap = std::max(overlap, books.max_penetration);
      lifted = std::max(lifted, books.energy_added_repair / books.energy_start);
    }
  }
  state.counters["overlap"] = overlap;
  state.counters["lifted"] = lifted;
  state.counters["cost"] = benchmark::Counter(
      row.duration * row.trays, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

const int kFalls = [] {
  for (const Fall& row :
       {Fall{"boxes", "draft", 200, 30, 5.0, 5}, Fall{"boxes", "draft", 200, 60, 5.0, 5},
        Fall{"boxes", "fast", 200, 60, 5.0, 5}, Fall{"boxes", "auto", 200, 240, 5.0, 5},
        Fall{"boxes", "balanced", 200, 60, 5.0, 5}, Fall{"balls", "draft", 200, 30, 5.0, 5},
        Fall{"balls", "draft", 200, 60, 5.0, 5}, Fall{"boxes", "draft", 1000, 30, 3.0, 1},
        Fall{"boxes", "auto", 1000, 240, 3.0, 1}})
    benchmark::RegisterBenchmark(titleOf(row).c_str(),
                                 [row](benchmark::State& state) { fall(state, row); })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1)
        ->Repetitions(1);
  return 0;
}();

}  // namespace
