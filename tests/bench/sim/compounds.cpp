// What Ls of two boxes that fall on each other cost, and as many boxes of their mass: 1.5 s, by the
// presets that crowds are for.
#include <benchmark/benchmark.h>

#include <string>

#include "sim/problem/problem.h"
#include "tests/world/falling_ells.h"

namespace {

using namespace tumble;

void dropped(benchmark::State& state, const Shape& shape, const SolverPreset& preset) {
  WorldDef def = fallingInColumns(shape, static_cast<int>(state.range(0)), 5, 1);
  def.stepping.take(preset);
  for (auto _ : state) {
    World world(def);
    world.advance(def.duration);
    const Certificate& books = world.report().certificate;
    state.counters["overlap"] = books.max_penetration;
    state.counters["by_audit"] = books.audit_max_penetration;
    state.counters["contacts"] = static_cast<double>(world.sample(def.duration).contacts.size());
  }
}

const int kDropped = [] {
  for (const char* name : {"auto", "fast", "draft"})
    for (const bool ells : {false, true}) {
      const std::string title = std::string("dropped: ") + (ells ? "Ls, " : "boxes, ") + name;
      const Shape shape = ells ? Shape(ellOfBoxes()) : Shape(boxLikeEll());
      benchmark::RegisterBenchmark(title.c_str(),
                                   [shape, name](benchmark::State& state) {
                                     dropped(state, shape, *findSolverPreset(name));
                                   })
          ->Unit(benchmark::kMillisecond)
          ->Iterations(1)
          ->Repetitions(1)
          ->Arg(50)
          ->Arg(200);
    }
  return 0;
}();

}  // namespace
