// What the method "auto" chooses by: the same scenes by the exact method and by stepping, from one
// body to many. Boxes tumble and rattle; balls fall and roll; towers stand.
#include <benchmark/benchmark.h>

#include <string>

#include "tests/world/scenes.h"

namespace {

using namespace tumble;

enum Kind { Boxes, Balls, Tower };

WorldDef sceneOf(Kind kind, int n) {
  const double restitution = kind == Tower ? 0.0 : 0.2;
  WorldDef def = scenes::worldOf("auto", 0.5, {scenes::ground(restitution, 0.4)});
  for (int i = 0; i < n; ++i) {
    BodyDef body;
    body.name = "body." + std::to_string(i);
    body.mass = 1.0;
    body.restitution = restitution;
    body.friction = 0.4;
    body.shape = kind == Balls ? Shape(Sphere{0.1}) : Shape(Box{{0.25, 0.25, 0.25}});
    body.position = kind == Tower ? Vec3(0.0, 0.25 + 0.5 * i, 0.0)
                                  : Vec3(1.0 * (i % 8), 0.5 + 0.01 * i, 1.0 * (i / 8));
    if (kind == Boxes) body.orientation = fromAxisAngle({1.0, 0.3 * i, 0.5}, 0.4 + 0.3 * i);
    def.bodies.push_back(body);
  }
  return def;
}

void runOf(benchmark::State& state, Kind kind, const char* method) {
  WorldDef def = sceneOf(kind, static_cast<int>(state.range(0)));
  def.method = method;
  for (auto _ : state) {
    World world(def);
    world.advance(def.duration);
    state.counters["steps"] = static_cast<double>(world.report().certificate.steps);
    state.counters["overlap"] = world.report().certificate.max_penetration;
  }
}

BENCHMARK_CAPTURE(runOf, boxes_auto, Boxes, "auto")->RangeMultiplier(2)->Range(1, 16);
BENCHMARK_CAPTURE(runOf, boxes_stepping, Boxes, "stepping")->RangeMultiplier(2)->Range(1, 16);
BENCHMARK_CAPTURE(runOf, balls_exact, Balls, "exact")->RangeMultiplier(4)->Range(1, 64);
BENCHMARK_CAPTURE(runOf, balls_stepping, Balls, "stepping")->RangeMultiplier(4)->Range(1, 64);
BENCHMARK_CAPTURE(runOf, tower_exact, Tower, "exact")->RangeMultiplier(2)->Range(1, 32);
BENCHMARK_CAPTURE(runOf, tower_stepping, Tower, "stepping")->RangeMultiplier(2)->Range(1, 32);

}  // namespace
