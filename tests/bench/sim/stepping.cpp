// What a whole step of stacks costs: at rest, where islands keep their forces, and drifting along
// on ice, where every step looks and solves anew.
#include <benchmark/benchmark.h>

#include <string>

#include "tests/world/scenes.h"

namespace {

using namespace tumble;

struct Stack {
  int nx, ny, nz;
  bool bonded;  ///< every other layer is shifted by half a box along x
};

constexpr Stack kStacks[] = {
    {1, 10, 1, false}, {6, 6, 6, false}, {6, 6, 6, true}, {10, 10, 10, true}};

WorldDef stackOf(const Stack& stack, double speed) {
  const double friction = speed > 0.0 ? 0.0 : 0.5;
  WorldDef def = scenes::worldOf("stepping", 1e6, {scenes::ground(0.0, friction)});
  for (int y = 0; y < stack.ny; ++y)
    for (int x = 0; x < stack.nx; ++x)
      for (int z = 0; z < stack.nz; ++z) {
        BodyDef box;
        box.name = "box." + std::to_string(def.bodies.size());
        box.shape = Box{{0.25, 0.25, 0.25}};
        box.mass = 1.0;
        box.friction = 0.5;
        box.position = {0.5 * x + (stack.bonded && y % 2 ? 0.24 : 0.0) + 0.01 * x, 0.25 + 0.5 * y,
                        0.6 * z};
        box.velocity = {speed, 0.0, 0.0};
        def.bodies.push_back(box);
      }
  return def;
}

void stepsOf(benchmark::State& state, double speed) {
  const WorldDef def = stackOf(kStacks[state.range(0)], speed);
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
