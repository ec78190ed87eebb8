// What a whole step costs: of stacks at rest, drifting along on ice, where every step looks anew
// and islands keep their forces, and pulled along, where they ask whether these still do; of a
// brick that slides, a ball that rolls and a car that turns.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "sim/problem/problem.h"
#include "tests/world/joints.h"
#include "tests/world/scenes.h"

namespace {

using namespace tumble;

struct Stack {
  int nx, ny, nz;
  bool bonded;  ///< every other layer is shifted by half a box along x
};

constexpr Stack kStacks[] = {
    {1, 10, 1, false}, {6, 6, 6, false}, {6, 6, 6, true}, {10, 10, 10, true}};

void stepsOf(benchmark::State& state, double speed, double pull) {
  const Stack& stack = kStacks[state.range(0)];
  const WorldDef def = scenes::stackOf(stack.nx, stack.ny, stack.nz, stack.bonded, speed, pull);
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
  stepsOf(state, 0.0, 0.0);
}
BENCHMARK(stackAtRest)->DenseRange(0, 3)->Unit(benchmark::kMicrosecond);

void stackDrifting(benchmark::State& state) {
  stepsOf(state, 0.1, 0.0);
}
BENCHMARK(stackDrifting)->DenseRange(0, 3)->Unit(benchmark::kMicrosecond);

void stackPulled(benchmark::State& state) {
  stepsOf(state, 0.1, 1e-3);
}
BENCHMARK(stackPulled)->DenseRange(0, 3)->Unit(benchmark::kMicrosecond);

/// A body that goes along a rough floor for a second, from a speed of 5 m/s on.
void along(benchmark::State& state, BodyDef body) {
  body.velocity.x() = 5.0;
  const WorldDef def = scenes::worldOf("stepping", 1.0, {scenes::ground(0.0, 0.5), body});
  for (auto _ : state) {
    World world(def);
    for (int k = 1; k <= 240; ++k) world.advance(k * def.stepping.step);
  }
  state.counters["per step"] = benchmark::Counter(
      240.0, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void brickSlides(benchmark::State& state) {
  along(state, scenes::box("brick", {0.3, 0.1, 0.2}, {0.0, 0.05, 0.0}, 0.0, 0.5));
}
BENCHMARK(brickSlides)->Unit(benchmark::kMicrosecond);

void ballRolls(benchmark::State& state) {
  BodyDef ball = scenes::ball("ball", 0.1, {0.0, 0.1, 0.0}, 0.0, 0.5);
  ball.angularVelocity.z() = -50.0;
  along(state, ball);
}
BENCHMARK(ballRolls)->Unit(benchmark::kMicrosecond);

/// Wheels on axles whose sideways forces are not determined: Newton's method ends above the
/// tolerance in most steps.
void carTurns(benchmark::State& state) {
  const WorldDef def = scenes::carOf(5.0, 0.2);
  for (auto _ : state) {
    World world(def);
    world.advance(def.duration);
  }
}
BENCHMARK(carTurns)->Unit(benchmark::kMillisecond);

/// A row of dominoes of which the first has been pushed.
WorldDef dominoes() {
  WorldDef def = scenes::worldOf("stepping", 1e6, {scenes::ground(0.0, 0.5)});
  for (int k = 0; k < 12; ++k)
    def.bodies.push_back(scenes::box("domino" + std::to_string(k), {0.05, 0.5, 0.25},
                                     {0.2 * k, 0.25, 0.0}, 0.0, 0.3));
  def.bodies[1].angularVelocity = {0.0, 0.0, -2.0};
  return def;
}

/// A pile in bond that a heavy ball runs into.
WorldDef disturbedPile() {
  WorldDef def = scenes::stackOf(6, 6, 6, true, 0.0);
  BodyDef ball = scenes::ball("ball", 0.4, {-1.5, 1.2, 1.5}, 0.0, 0.5);
  ball.mass = 50.0;
  ball.velocity = {8.0, 0.0, 0.0};
  def.bodies.push_back(ball);
  return def;
}

/// Each step of the fifth of a second after the hit: the median, and what one in a hundred exceeds.
void stepsWhenDisturbed(benchmark::State& state, const SolverPreset& preset) {
  WorldDef def = disturbedPile();
  def.stepping.take(preset);
  const double h = def.stepping.step;
  std::vector<double> seconds;
  double residual = 0.0;
  for (auto _ : state) {
    World world(def);
    world.advance(24 * h);
    for (int k = 25; k <= 72; ++k) {
      const std::clock_t start = std::clock();
      world.advance(k * h);
      seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    residual = world.report().certificate.max_complementarity;
  }
  std::sort(seconds.begin(), seconds.end());
  const auto part = [&](double p) {
    return seconds[static_cast<std::size_t>(p * static_cast<double>(seconds.size() - 1))];
  };
  state.counters["median"] = part(0.5);
  state.counters["99 %"] = part(0.99);
  state.counters["residual"] = residual;
}

/// Two seconds from the start, with one of the presets.
void secondsBy(benchmark::State& state, WorldDef def, const SolverPreset& preset) {
  def.stepping.take(preset);
  double residual = 0.0, steps = 0.0;
  for (auto _ : state) {
    World world(def);
    for (int k = 1; k <= 20; ++k) world.advance(0.1 * k);
    residual = world.report().certificate.max_complementarity;
    steps += static_cast<double>(world.report().certificate.steps);
  }
  state.counters["residual"] = residual;
  state.counters["per step"] =
      benchmark::Counter(steps, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

const int kPresets = [] {
  const std::pair<const char*, WorldDef> worlds[] = {
      {"tower", scenes::stackOf(1, 10, 1, false, 0.1, 1e-3)},
      {"pile", scenes::stackOf(6, 6, 6, true, 0.1, 1e-3)},
      {"dominoes", dominoes()}};
  for (const auto& [name, def] : worlds)
    for (const SolverPreset& preset : solverPresets())
      benchmark::RegisterBenchmark(
          ("preset " + std::string(preset.name) + ": " + name).c_str(),
          [&preset, def = def](benchmark::State& state) { secondsBy(state, def, preset); })
          ->Unit(benchmark::kMillisecond);
  for (const SolverPreset& preset : solverPresets())
    benchmark::RegisterBenchmark(
        ("disturbed pile, " + std::string(preset.name)).c_str(),
        [&preset](benchmark::State& state) { stepsWhenDisturbed(state, preset); })
        ->Unit(benchmark::kMillisecond);
  return 0;
}();

}  // namespace
