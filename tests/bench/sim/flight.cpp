// What closed-form flight costs: a start, an evaluation, and many bodies sampled.
#include "sim/flight/flight.h"

#include <benchmark/benchmark.h>

#include <vector>

#include "tests/body/bodies.h"

namespace {

using namespace tumble;

/// A brick of 0.1 × 0.2 × 0.3 m that spins at 10 rad/s about its middle axis with a wobble [rad/s]:
/// a small one takes it by the separatrix.
RigidBody brick(double wobble) {
  RigidBody body = makeBody(solidMass(Box{{0.05, 0.1, 0.15}}, 1.0));
  body.q = fromAxisAngle({1.0, 2.0, -0.5}, 0.8);
  setVelocity(body, {1.0, 2.0, 0.0}, body.q * Vec3(wobble, 10.0, 0.0));
  return body;
}

const Vec3 kGravity(0.0, -9.81, 0.0);

RigidBody choose(int kind) {
  if (kind == 0) return brick(1e-3);
  if (kind == 1) return brick(8.0);
  return tumble::test::tumblingCylinder();
}

void start(benchmark::State& state) {
  const RigidBody body = choose(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    Flight flight(body, kGravity, 0.0);
    benchmark::DoNotOptimize(flight);
  }
}

void pose(benchmark::State& state) {
  const Flight flight(choose(static_cast<int>(state.range(0))), kGravity, 0.0);
  double t = 0.0;
  for (auto _ : state) {
    Pose now = flight.pose(t);
    benchmark::DoNotOptimize(now);
    t = t < 10.0 ? t + 0.0137 : 0.0;
  }
}

void wholeState(benchmark::State& state) {
  RigidBody body = choose(static_cast<int>(state.range(0)));
  const Flight flight(body, kGravity, 0.0);
  double t = 0.0;
  for (auto _ : state) {
    flight.at(t, body);
    benchmark::DoNotOptimize(body);
    t = t < 10.0 ? t + 0.0137 : 0.0;
  }
}

/// Bodies sampled 60 times a second for 10 s, states only.
void sampled(benchmark::State& state) {
  std::vector<RigidBody> bodies;
  for (int n = 0; n < state.range(0); ++n) bodies.push_back(brick(0.01 + 0.001 * n));
  for (auto _ : state) {
    std::vector<Flight> flights;
    flights.reserve(bodies.size());
    for (const RigidBody& body : bodies) flights.emplace_back(body, kGravity, 0.0);
    for (int sample = 0; sample <= 600; ++sample) {
      for (std::size_t i = 0; i < bodies.size(); ++i) flights[i].at(sample / 60.0, bodies[i]);
    }
    benchmark::ClobberMemory();
  }
}

// 0: by the separatrix, 1: a spin that keeps its axis, 2: a symmetric body.
BENCHMARK(start)->Name("flight: start")->Arg(0)->Arg(1)->Arg(2);
BENCHMARK(pose)->Name("flight: pose at t")->Arg(0)->Arg(1)->Arg(2);
BENCHMARK(wholeState)->Name("flight: state at t")->Arg(0)->Arg(1)->Arg(2);
BENCHMARK(sampled)
    ->Name("flight: bodies sampled 60/s for 10 s")
    ->Arg(10000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
