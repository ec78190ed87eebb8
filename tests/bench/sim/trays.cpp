// What bodies that fall into a tray cost by `stepping`, and how deep they ever overlap.
#include <benchmark/benchmark.h>

#include <string>

#include "sim/problem/problem.h"
#include "tests/world/tray.h"

namespace {

using namespace tumble;

struct Fall {
  const char *bodies, *preset;
  int count, rate;  ///< bodies; steps per second
  double duration;  ///< [s]
};

std::string titleOf(const Fall& row) {
  return "tray: " + std::to_string(row.count) + ' ' + row.bodies + ", " + row.preset + ", " +
         std::to_string(row.rate) + "/s";
}

/// `cost`: CPU seconds for a simulated second; `overlap` [m]; `lifted`: of the energy at the start.
void fall(benchmark::State& state, const Fall& row) {
  const bool balls = row.bodies == std::string_view("balls");
  WorldDef def = scenes::tray(balls ? Shape(Sphere{0.15}) : scenes::kBrick, row.count);
  def.duration = row.duration;
  def.stepping.step = 1.0 / row.rate;
  def.stepping.take(*findSolverPreset(row.preset));
  for (auto _ : state) {
    World world(def);
    world.advance(def.duration);
    const Certificate& books = world.report().certificate;
    state.counters["overlap"] = books.max_penetration;
    state.counters["lifted"] = books.energy_added_repair / books.energy_start;
  }
  state.counters["cost"] =
      benchmark::Counter(row.duration, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

const int kFalls = [] {
  for (const Fall& row :
       {Fall{"boxes", "draft", 200, 30, 5.0}, Fall{"boxes", "draft", 200, 60, 5.0},
        Fall{"boxes", "fast", 200, 60, 5.0}, Fall{"boxes", "auto", 200, 240, 5.0},
        Fall{"boxes", "balanced", 200, 60, 5.0}, Fall{"balls", "draft", 200, 30, 5.0},
        Fall{"balls", "draft", 200, 60, 5.0}, Fall{"boxes", "draft", 1000, 30, 3.0},
        Fall{"boxes", "auto", 1000, 240, 3.0}})
    benchmark::RegisterBenchmark(titleOf(row).c_str(),
                                 [row](benchmark::State& state) { fall(state, row); })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1)
        ->Repetitions(1);
  return 0;
}();

}  // namespace
