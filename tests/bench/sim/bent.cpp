// What a step of what bends costs, by preset: a cloth of 61 × 61 points that falls on a ball, with
// friction and without, and boxes of jello that fall on a floor. Means over the time given.
#include <benchmark/benchmark.h>

#include <cmath>

#include "sim/problem/problem.h"
#include "sim/world.h"
#include "tests/world/bent_bodies.h"

namespace {

using namespace tumble;

void stepsOf(benchmark::State& state, WorldDef def, const char* preset) {
  def.stepping.take(*findSolverPreset(preset));
  const int steps = static_cast<int>(std::lround(def.duration / def.stepping.step));
  for (auto _ : state) {
    World world(def);
    for (int k = 1; k <= steps; ++k) world.advance(k * def.stepping.step);
    state.counters["balance"] = world.report().certificate.energy_balance_error;
    state.counters["sunk"] = world.report().certificate.max_penetration;
  }
  state.counters["steps"] =
      benchmark::Counter(steps, benchmark::Counter::kIsIterationInvariantRate);
}

WorldDef fallingCloth(double friction) {
  WorldDef def = clothOnBall(61, 1.2, 1000.0, 0.35, friction);
  def.duration = 0.4;
  return def;
}

WorldDef jello(const Eigen::Vector3i& cells) {
  WorldDef def;
  def.duration = 0.4;
  def.stepping.step = 1.0 / 120.0;
  def.bodies.push_back(
      {.name = "floor", .shape = HalfSpace{}, .mass = 1.0, .friction = 0.6, .fixed = true});
  SoftDef soft;
  soft.cells = {cells.x(), cells.y(), cells.z()};
  soft.size = 0.05 * cells.cast<double>();
  soft.solid = solidityOf(15000.0, 0.4, 20.0);
  addSoft(def, soft, {0.0, 0.5 * soft.size.y() + 0.05, 0.0}, 0.005);
  return def;
}

void clothOfFast(benchmark::State& state) {
  stepsOf(state, fallingCloth(state.range(0) == 0 ? 0.0 : 0.3), "fast");
}
BENCHMARK(clothOfFast)->DenseRange(0, 1)->Unit(benchmark::kMillisecond)->Iterations(1);

void clothOfExact(benchmark::State& state) {
  stepsOf(state, fallingCloth(state.range(0) == 0 ? 0.0 : 0.3), "exact");
}
BENCHMARK(clothOfExact)->DenseRange(0, 1)->Unit(benchmark::kMillisecond)->Iterations(1);

void jelloOfFast(benchmark::State& state) {
  stepsOf(state,
          jello(state.range(0) == 0 ? Eigen::Vector3i(9, 3, 7) : Eigen::Vector3i(20, 20, 20)),
          "fast");
}
BENCHMARK(jelloOfFast)->DenseRange(0, 1)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
