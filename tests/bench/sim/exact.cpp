// What a world of the exact method costs: many bodies sampled, and the search for the first touch.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "sim/body/mass_properties.h"
#include "sim/collide/approach.h"
#include "sim/collide/collide.h"
#include "sim/math/root.h"
#include "sim/math/rotation.h"
#include "tests/world/scenes.h"

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

/// A brick of 0.1 × 0.2 × 0.3 m on its way.
struct Brick {
  Brick(const Vec3& x, const Quat& q, const Vec3& v, const Vec3& omega, const Vec3& g)
      : body(start(x, q, v, omega)), flight(body, g, 0.0) {}
  static RigidBody start(const Vec3& x, const Quat& q, const Vec3& v, const Vec3& omega) {
    RigidBody b = makeBody(solidMass(kShape, 1.0));
    b.x = x;
    b.q = q;
    updateDerived(b);
    setVelocity(b, v, omega);
    return b;
  }
  Flyer flyer() { return {&flight, &kConvex, &body}; }

  static inline const Shape kShape = Box{{0.05, 0.1, 0.15}};
  static inline const Convex kConvex{kShape, {}, outlineOf(kShape)};
  RigidBody body;
  Flight flight;
};

/// Two bodies that are about to meet; b may be a floor.
struct Meeting {
  Brick a, b;
  bool floor;
};

std::vector<Meeting> meetings(bool floor, int count) {
  std::mt19937_64 engine(3);
  const auto draw = [&](double size) {
    return size * (2.0 * std::ldexp(static_cast<double>(engine() >> 11), -53) - 1.0);
  };
  const auto vector = [&](double size) {
    const double x = draw(size), y = draw(size), z = draw(size);
    return Vec3(x, y, z);
  };
  const auto turned = [&] {
    const Vec3 axis = vector(1.0);
    return fromAxisAngle(axis, draw(3.0));
  };
  std::vector<Meeting> list;
  for (int k = 0; k < count; ++k) {
    const Vec3 x(0.0, 1.2, 0.0), v = vector(1.0), spin = vector(10.0), other = vector(10.0);
    const Quat q = turned(), p = turned();
    const Vec3 g(0.0, -9.81, 0.0);
    list.push_back({Brick(x, q, floor ? v : Vec3(0.0, -3.0, 0.0), spin, g),
                    Brick(Vec3::Zero(), p, Vec3::Zero(), other, floor ? g : Vec3(0.3 * g)), floor});
  }
  return list;
}

const Shape kFloor = HalfSpace{};
const Convex kFloorConvex{kFloor, {}, {}};

/// The first touch, certified, to the last digit.
void firstTouch(benchmark::State& state, bool floor) {
  std::vector<Meeting> list = meetings(floor, 2000);
  RigidBody ground = makeFixedBody(Pose{}, Vec3::Zero(), Vec3::Zero());
  const Flight still(ground, Vec3::Zero(), 0.0);
  long looks = 0, count = 0, met = 0;
  for (auto _ : state) {
    Meeting& m = list[static_cast<std::size_t>(count++) % list.size()];
    const Flyer b = floor ? Flyer{&still, &kFloorConvex, &ground} : m.b.flyer();
    Approach approach(m.a.flyer(), b, 1e-11);
    const auto touch = approach.firstTouch(0.0, 2.0, true);
    met += touch.has_value();
    looks += approach.evaluations();
  }
  state.counters["evaluations"] = static_cast<double>(looks) / static_cast<double>(count);
  state.counters["met"] = static_cast<double>(met) / static_cast<double>(count);
}

/// What it is held against: a look every 1/60 s and bisection, which may miss a touch.
void sampledTouch(benchmark::State& state, bool floor) {
  std::vector<Meeting> list = meetings(floor, 2000);
  long looks = 0, count = 0;
  for (auto _ : state) {
    Meeting& m = list[static_cast<std::size_t>(count++) % list.size()];
    const auto gap = [&](double t) {
      ++looks;
      return separation(Brick::kShape, m.a.flight.pose(t), floor ? kFloor : Brick::kShape,
                        floor ? Pose{} : m.b.flight.pose(t));
    };
    for (int k = 1; k <= 120; ++k) {
      if (gap(k / 60.0) > 0.0) continue;
      benchmark::DoNotOptimize(
          bisect([&](double t) { return gap(t) <= 0.0; }, (k - 1) / 60.0, k / 60.0, 1e-14));
      break;
    }
  }
  state.counters["evaluations"] = static_cast<double>(looks) / static_cast<double>(count);
}

/// 49 elastic balls that fall on a floor, 20 s, the energy read 60 times a second.
void bouncing(benchmark::State& state) {
  WorldDef def = scenes::worldOf("exact", 20.0, {scenes::ground(1.0)});
  for (int i = 0; i < 49; ++i) {
    BodyDef ball;
    ball.name = "ball." + std::to_string(i);
    ball.shape = Sphere{0.1};
    ball.mass = 10.0;
    ball.position = {2.0 * (i % 7), 5.0, 2.0 * (i / 7)};
    def.bodies.push_back(ball);
  }
  double squares = 0.0;
  for (auto _ : state) {
    World world(def);
    squares = 0.0;
    double first = 0.0;
    for (int k = 0; k <= 1200; ++k) {
      world.advance(k / 60.0);
      const Sample sample = world.sample(k / 60.0);
      if (k == 0) first = sample.kinetic + sample.potential;
      squares += std::pow(sample.kinetic + sample.potential - first, 2);
    }
  }
  state.counters["mean squared energy error, J2"] = squares / 1201.0;
}

/// A light ball between a wall and one of 1e10 times its mass: 314159 collisions.
void counting(benchmark::State& state) {
  WorldDef def;
  def.method = "exact";
  def.duration = 100.0;
  def.gravity.setZero();
  BodyDef wall, light, heavy;
  wall.name = "wall";
  wall.shape = HalfSpace{Vec3::UnitX(), 0.0};
  wall.fixed = true;
  wall.restitution = 1.0;
  light.name = "light";
  light.mass = 1.0;
  light.position = {2.0, 0.0, 0.0};
  light.restitution = 1.0;
  heavy = light;
  heavy.name = "heavy";
  heavy.mass = 1e10;
  heavy.position = {4.0, 0.0, 0.0};
  heavy.velocity = {-1.0, 0.0, 0.0};
  def.bodies = {wall, light, heavy};
  for (auto _ : state) {
    World world(def);
    world.advance(100.0);
    state.counters["collisions"] = static_cast<double>(world.report().events.size());
  }
}

BENCHMARK(counting)->Name("exact: counting to 314159 by collisions")->Unit(benchmark::kMillisecond);
BENCHMARK(bouncing)->Name("exact: 49 elastic balls, 20 s")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(firstTouch, floor, true)
    ->Name("exact: first touch of a tumbling brick and a floor");
BENCHMARK_CAPTURE(firstTouch, bricks, false)->Name("exact: first touch of two tumbling bricks");
BENCHMARK_CAPTURE(sampledTouch, floor, true)->Name("1/60 s and bisection: a brick and a floor");
BENCHMARK_CAPTURE(sampledTouch, bricks, false)->Name("1/60 s and bisection: two bricks");
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
