// What a world of the exact method costs: many bodies sampled, and the search for the first touch.
#include <benchmark/benchmark.h>

#include <string>

#include "sim/world.h"

namespace {

using namespace tumble;

/// Bricks on a lattice, each with a spin and a drift of its own, falling together.
WorldDef swarm(int n, double drift) {
  WorldDef def;
  def.method = "exact";
  def.duration = 10.0;
  for (int i = 0; i < n; ++i) {
    BodyDef brick;
    brick.name = "brick." + std::to_string(i);
    brick.shape = Box{{0.05, 0.1, 0.15}};
    brick.density = 1000.0;
    brick.position = {1.0 * (i % 22), 1.0 * (i / 22 % 22), 1.0 * (i / 484)};
    brick.velocity = drift * Vec3(i % 7 - 3, i % 5 - 2, i % 3 - 1);
    brick.angularVelocity = {1e-3 * i, 10.0, 0.1 * (i % 11)};
    def.bodies.push_back(brick);
  }
  return def;
}

/// Samples 60 times a second for 10 s: states of all bodies, and the certainty that none touch.
void sampled(benchmark::State& state) {
  const WorldDef def = swarm(static_cast<int>(state.range(0)), 0.005);
  for (auto _ : state) {
    state.PauseTiming();
    World world(def);
    state.ResumeTiming();
    for (int k = 0; k <= 600; ++k) {
      world.advance(k / 60.0);
      Sample sample = world.sample(k / 60.0);
      benchmark::DoNotOptimize(sample);
    }
    if (world.report().stopped) state.SkipWithError(world.report().reason.c_str());
  }
}

/// To the first touch of all, or the end.
void search(benchmark::State& state) {
  const WorldDef def = swarm(static_cast<int>(state.range(0)), 1e-3 * state.range(1));
  for (auto _ : state) {
    state.PauseTiming();
    World world(def);
    state.ResumeTiming();
    world.advance(10.0);
  }
}

BENCHMARK(sampled)
    ->Name("exact: bodies sampled 60/s for 10 s, no touch for certain")
    ->Arg(10000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(search)
    ->Name("exact: first touch of bodies that drift at up to 5 mm/s, 10 s")
    ->Args({100, 2})
    ->Args({1000, 2})
    ->Args({10000, 2})
    ->Unit(benchmark::kMillisecond);

}  // namespace
