// What a step of what bends costs, by preset: a cloth of 61 × 61 points that falls on a ball, with
// friction and without, boxes of jello that fall on a floor, and hair of 6,000 points on a ball,
// which a capsule brushes. Means over the time given.
#include <benchmark/benchmark.h>

#include <cmath>

#include "sim/elastic/strand.h"
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

/// 600 strands of ten points, evenly on a ball, and a capsule that comes through them.
WorldDef brushedHair() {
  constexpr int kStrands = 600;
  constexpr double kRadius = 0.2, kGoldenAngle = 2.399963229728653;
  WorldDef def;
  def.duration = 0.8;
  def.stepping.step = 1.0 / 120.0;
  def.bodies.push_back(
      {.name = "ball", .shape = Sphere{kRadius}, .mass = 1.0, .friction = 0.3, .fixed = true});
  def.bodies.push_back({.name = "brush",
                        .shape = Capsule{0.05, 0.6},
                        .mass = 1.0,
                        .friction = 0.3,
                        .position = {-0.4, 0.26, 0.0},
                        .orientation = Quat::FromTwoVectors(Vec3::UnitY(), Vec3::UnitZ()),
                        .velocity = {0.6, 0.0, 0.0},
                        .fixed = true});
  const StrandDef strand{.points = 10,
                         .length = 0.12,
                         .density = 0.002,
                         .stretch = 20.0,
                         .bend = 1.5e-5,
                         .damping = 0.002};
  for (int k = 0; k < kStrands; ++k) {
    const double y = 1.0 - (2.0 * k + 1.0) / kStrands, r = std::sqrt(1.0 - y * y);
    const Vec3 out(r * std::cos(kGoldenAngle * k), y, r * std::sin(kGoldenAngle * k));
    std::vector<Vec3> places = strandPlaces(strand);
    for (Vec3& place : places) place = Quat::FromTwoVectors(Vec3::UnitY(), out) * place;
    const int first = addPoints(def, "hair." + std::to_string(k), places, strandMasses(strand),
                                kRadius * out, 0.002, 0.3);
    for (const int root : {first, first + 1}) {
      def.bodies[root].shape = Particle{};
      def.bodies[root].fixed = true;
    }
    bend(def, "hair." + std::to_string(k), first, strandElements(strand, first));
  }
  return def;
}

void hairOfFast(benchmark::State& state) {
  stepsOf(state, brushedHair(), "fast");
}
BENCHMARK(hairOfFast)->Unit(benchmark::kMillisecond)->Iterations(1);

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
