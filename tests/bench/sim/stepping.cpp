// What a whole step of stacks costs: at rest, where islands keep their forces, and drifting along
// on ice, where every step looks and solves anew.
#include <benchmark/benchmark.h>

#include "tests/world/scenes.h"

namespace {

using namespace tumble;

struct Stack {
  int nx, ny, nz;
  bool bonded;  ///< every other layer is shifted by half a box along x
};

constexpr Stack kStacks[] = {
    {1, 10, 1, false}, {6, 6, 6, false}, {6, 6, 6, true}, {10, 10, 10, true}};

void stepsOf(benchmark::State& state, double speed) {
  const Stack& stack = kStacks[state.range(0)];
  const WorldDef def = scenes::stackOf(stack.nx, stack.ny, stack.nz, stack.bonded, speed);
  World world(def);
  const double h = def.stepping.step;
  long step = 0;
  for (int k = 0; k < 10; ++k) world.advance(static_cast<double>(++step) * h);
  for (auto _ : state) world.advance(static_cast<double>(++step) * h);
  const double t = static_cast<double>(step) * h;
  state.counters["contacts"] = static_cast<double>(world.sample(t).contacts.size());
  state.counters["residual"] = world.report().certificate.max_complementarity;
}

void stackAtRest(benchmark::State& state) {
  stepsOf(state, 0.0);
}
BENCHMARK(stackAtRest)->DenseRange(0, 3)->Unit(benchmark::kMicrosecond);

void stackDrifting(benchmark::State& state) {
  stepsOf(state, 0.1);
}
BENCHMARK(stackDrifting)->DenseRange(0, 3)->Unit(benchmark::kMicrosecond);

}  // namespace
