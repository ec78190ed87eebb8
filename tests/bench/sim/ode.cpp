// What a step of each integrator costs with a tumbling body in its hands, and ten seconds of a top.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "sim/body/body_system.h"
#include "sim/flight/top.h"
#include "sim/ode/integrator.h"
#include "tests/body/bodies.h"

namespace {

using namespace tumble;

const Vec3 kGravity(0.0, -9.81, 0.0);

void step(benchmark::State& state, const Integrator& row, const RigidBody& body) {
  const BodySystem system(kGravity, {}, {body});
  const auto stepper = row.make(system.size());
  std::vector<double> start(system.size()), y;
  system.toArray(start);
  for (auto _ : state) {
    y = start;
    stepper->step(system, 0.0, 1.0 / 240.0, y);
    benchmark::DoNotOptimize(y.data());
  }
}

void top(benchmark::State& state) {
  RigidBody disc = makeBody({1.0, Vec3(0.0025, 0.005, 0.0025).asDiagonal()});
  disc.q = fromAxisAngle({0.2, 0.1, 1.0}, 0.9);
  updateDerived(disc);
  const Pivot pivot = makePivot(disc, 0, {0.0, -0.1, 0.0});
  const Vec3 omega = disc.q * Vec3(1.0, 150.0, -2.0);
  setVelocity(disc, omega.cross(disc.x - pivot.p), omega);
  for (auto _ : state) {
    HeavyTop flight(disc, pivot, kGravity, 0.0);
    flight.reach(10.0);
    flight.at(10.0, disc);
    benchmark::DoNotOptimize(disc);
  }
}

BENCHMARK(top)->Name("heavy top: 10 s at 150 rad/s")->Unit(benchmark::kMicrosecond);

const int kSteps = [] {
  for (const Integrator& row : integrators()) {
    const bool exact = row.needs.split == Split::Exact;
    const RigidBody body = exact ? test::tumblingCylinder() : test::tumblingBrick();
    benchmark::RegisterBenchmark(("step of 1/240 s: " + std::string(row.name)).c_str(),
                                 [&row, body](benchmark::State& state) { step(state, row, body); });
  }
  return 0;
}();

}  // namespace
