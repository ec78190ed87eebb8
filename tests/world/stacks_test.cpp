// What rests by time stepping: towers of any masses, loads on slopes, balls on a box, heaps.
#include <ctime>

#include "tests/catch.h"
#include "tests/problem/problems.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

constexpr double kWeight = 9.81;  // N/kg

WorldDef steppingWorld(double duration, double step) {
  WorldDef def;
  def.method = "stepping";
  def.duration = duration;
  def.stepping.step = step;
  return def;
}

BodyDef heavyBox(const std::string& name, double mass, const Vec3& edges, const Vec3& x,
                 double mu) {
  BodyDef def = box(name, edges, x, 0.0, mu);
  def.density.reset();
  def.mass = mass;
  return def;
}

/// Cubes of 0.5 m on each other, the first on the ground, off the middle so that nothing is zero.
WorldDef heavyTower(const std::vector<double>& masses, double duration) {
  WorldDef def = steppingWorld(duration, 1.0 / 240.0);
  def.bodies = {ground(0.0, 0.5)};
  for (std::size_t i = 0; i < masses.size(); ++i)
    def.bodies.push_back(heavyBox("box" + std::to_string(i), masses[i], {0.5, 0.5, 0.5},
                                  {0.1, 0.25 + 0.5 * static_cast<double>(i), -0.3}, 0.5));
  return def;
}

struct Standing {
  double drift = 0.0, early = 0.0;  // m, in all and in the first 6 s
  double force = 0.0;               // relative error of the load of a level
};

/// Lets a tower stand.
Standing stand(World& world) {
  const std::vector<BodyDef>& bodies = world.model().def.bodies;
  Standing standing;
  Sample now;
  for (int k = 1; k <= static_cast<int>(4.0 * world.model().def.duration); ++k) {
    world.advance(0.25 * k);
    now = world.sample(0.25 * k);
    for (std::size_t i = 1; i < bodies.size(); ++i)
      standing.drift = std::max(standing.drift, (now.bodies[i].x - bodies[i].position).norm());
    if (k <= 24) standing.early = standing.drift;
  }
  std::vector<double> load(bodies.size(), 0.0);
  for (const ContactSample& c : now.contacts) load[c.a] += c.force.y();
  double above = 0.0;
  for (std::size_t i = bodies.size(); i-- > 1;) {
    above += kWeight * *bodies[i].mass;
    standing.force = std::max(standing.force, std::abs(load[i] / above - 1.0));
  }
  return standing;
}

std::vector<double> doubling(int n) {
  std::vector<double> masses;
  for (int i = 0; i < n; ++i) masses.push_back(std::ldexp(1.0, i));
  return masses;
}

struct TowerCase {
  const char* name;
  std::vector<double> masses;
};

std::vector<TowerCase> towers() {
  return {{"ten equal", std::vector<double>(10, 1.0)},
          {"ten, 2^i upward", doubling(10)},
          {"twenty, 2^i upward", doubling(20)},
          {"1000 kg on 1 kg", {1.0, 1e3}},
          {"1000 kg on 1 g", {1e-3, 1e3}},
          {"a hundred equal", std::vector<double>(100, 1.0)}};
}

void checkTower(const TowerCase& tower_case, double duration) {
  World world(heavyTower(tower_case.masses, duration));
  const Standing s = stand(world);
  const Certificate& books = world.report().certificate;
  WARN("tower of " << tower_case.name << ", " << duration << " s: drift " << s.drift
                   << " m, forces " << s.force << ", residual " << books.max_complementarity);
  CHECK(s.drift < 1e-9);
  CHECK(s.drift <= 10.0 * s.early + 1e-12);
  CHECK(s.force < 1e-10);
  CHECK(books.max_complementarity <= 1e-12);
  CHECK(books.max_penetration < 1e-9);
}

}  // namespace

// Oracle: what stands at rest stays, and each level carries the weight above it. Measured: drift 0,
// forces 3e-13, residual 3e-15; allowed 1e-9 m, 1e-10, 1e-12.
TEST_CASE("towers of any masses stand, and carry what is above") {
  for (const TowerCase& tower_case : towers()) checkTower(tower_case, 6.0);
}

// The same for ten minutes. Measured: drift 0, forces 3e-13, residual 3e-15.
TEST_CASE("towers of any masses stand for ten minutes", "[long][figures]") {
  for (const TowerCase& tower_case : towers()) checkTower(tower_case, 600.0);
}

// Oracle: Coulomb's law, tan θ = mu, at 1 ± 1e-6 of it, on a slope turned about the vertical.
// Measured: sticks 0 m in 2 s; slides within 0.5 % of ½ g cos θ (tan θ − mu) t², a step h early:
// ½ a t (t + h). Allowed 1e-9 m, 1 %.
TEST_CASE("stepping: a block sticks just above the friction that holds it, and slides just below") {
  for (const double turn : {0.0, 0.7, 2.0}) {
    for (const double degrees : {10.0, 30.0, 50.0}) {
      const double angle = degrees * M_PI / 180.0;
      for (const double side : {1.0, -1.0}) {
        const double mu = std::tan(angle) * (1.0 + side * 1e-6);
        const Quat q = fromAxisAngle(Vec3::UnitY(), turn) * fromAxisAngle(Vec3::UnitZ(), -angle);
        WorldDef def = steppingWorld(2.0, 1.0 / 240.0);
        BodyDef slope = ground(0.0, mu);
        slope.shape = HalfSpace{q * Vec3::UnitY(), 0.0};
        def.bodies = {slope, heavyBox("block", 2.0, {0.4, 0.2, 0.3}, q * Vec3(0.0, 0.1, 0.0), mu)};
        def.bodies[1].orientation = q;
        World world(def);
        const Vec3 way = run(world).bodies[1].x - def.bodies[1].position;
        const double h = def.stepping.step, a = kWeight * std::cos(angle) * (std::tan(angle) - mu);
        CAPTURE(turn, degrees, side, way.norm());
        if (side > 0.0)
          CHECK(way.norm() < 1e-9);
        else
          CHECK(way.dot(q * Vec3::UnitX()) == Approx(0.5 * a * 2.0 * (2.0 + h)).epsilon(0.01));
      }
    }
  }
}

// Oracle: constant accelerations (SimBenchmark, "rolling"): 25 balls roll on a box that is pushed
// over the floor. Implicit steps of constant forces end with exact velocities. Measured 2e-26
// m²/s², allowed 1e-20.
TEST_CASE("balls roll on a box that is pushed, at the speeds of the closed form", "[figures]") {
  const double M = 10.0, m = 1.0, F = 150.0, h = 1e-3, r = 0.1;
  WorldDef def = steppingWorld(4.0, h);
  def.bodies = {ground(0.0, 0.4), heavyBox("box", M, {20.0, 0.2, 20.0}, {0.0, 0.1, 0.0}, 0.4)};
  def.bodies[0].material = "floor";
  def.bodies[1].material = "box";
  for (int i = 0; i < 25; ++i) {
    BodyDef b = ball("ball" + std::to_string(i), r, {(i % 5 - 2) * 1.0, 0.2 + r, (i / 5 - 2) * 1.0},
                     0.0, 0.8);
    b.material = "ball";
    def.bodies.push_back(b);
  }
  def.pairs = {{"ball", "box", {}, 0.8}, {"box", "floor", {}, 0.4}};
  const Vec3 along(0.5, 0.0, std::sqrt(0.75));
  def.forces = {UniformWind{.body = 1, .force = F * along}};
  World world(def);
  const double f1 = 0.4 * (M + 25.0 * m) * kWeight;
  const double f2 = ((F - f1) / M) / (3.5 / m + 25.0 / M);
  const double box = (F - f1 - 25.0 * f2) / M, rolling = f2 / m;
  double sum = 0.0;
  int count = 0;
  for (int step = 100; step <= 4000; step += 100, ++count) {
    const double t = step * h;
    world.advance(t);
    const Sample now = world.sample(t);
    sum += (now.bodies[1].v - box * t * along).squaredNorm() +
           (now.bodies[2].v - rolling * t * along).squaredNorm();
  }
  WARN("rolling balls: mean error " << sum / count << " m2/s2");
  CHECK(sum / count < 1e-20);
}

// Oracle: none penetrates (SimBenchmark, "666", with offsets of its own). Sum over pairs and floor
// of squared depths, its mean over the steps; published: 1.35e-4 m² at this step. Allowed 1.3e-4.
TEST_CASE("a heap of 216 balls does not sink into itself", "[long][figures]") {
  WorldDef def = steppingWorld(10.0, 1e-3);
  def.bodies = {ground()};
  test::Draw draw(666);
  const double r = 0.1, pitch = 0.21;
  for (int i = 0; i < 216; ++i) {
    const double dx = draw(0.0, 1e-3), dy = draw(0.0, 1e-3), dz = draw(0.0, 1e-3);
    BodyDef b = ball("ball" + std::to_string(i), r,
                     {i % 6 * pitch + dx, 0.101 + i / 36 * pitch + dy, i / 6 % 6 * pitch + dz});
    b.mass = 10.0;
    def.bodies.push_back(b);
  }
  World world(def);
  double sum = 0.0, cpu = 0.0;
  for (int k = 1; k <= 10000; ++k) {
    const std::clock_t start = std::clock();
    world.advance(k * 1e-3);
    cpu += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const Sample now = world.sample(k * 1e-3);
    for (int i = 1; i <= 216; ++i) {
      const double floor = std::max(0.0, r - now.bodies[i].x.y());
      sum += floor * floor;
      for (int j = 1; j < i; ++j) {
        const double d2 = (now.bodies[i].x - now.bodies[j].x).squaredNorm();
        if (d2 >= 4.0 * r * r) continue;
        const double depth = 2.0 * r - std::sqrt(d2);
        sum += depth * depth;
      }
    }
  }
  WARN("heap of 216 balls: mean " << sum / 1e4 << " m2, " << cpu << " CPU s");
  CHECK(sum / 1e4 < 1.3e-4);
}

// Oracle: weight. Measured: 4e-14 of it, residual 5e-15. Its 1,728 rows are too many for a dense
// factor of all of them.
TEST_CASE("exact holds a pyramid of 78 bricks, one island, without a dense factor of it") {
  constexpr int kRows = 12;
  WorldDef def;
  def.method = "exact";
  def.duration = 1.0;
  def.bodies = {ground(0.0, 0.5)};
  for (int row = 0; row < kRows; ++row)
    for (int k = 0; k < kRows - row; ++k)
      def.bodies.push_back(heavyBox("brick" + std::to_string(def.bodies.size()), 2.0,
                                    {0.2, 0.1, 0.1}, {0.2 * k + 0.1 * row, 0.05 + 0.1 * row, 0.0},
                                    0.5));
  World world(def);
  world.advance(def.duration);
  REQUIRE_FALSE(world.report().stopped);
  CHECK(world.report().certificate.max_complementarity <= 1e-12);
  const Sample end = world.sample(def.duration);
  double carried = 0.0;
  for (const ContactSample& c : end.contacts) carried += c.b == 0 ? c.force.y() : 0.0;
  CHECK(carried == Approx(78 * 2.0 * kWeight).epsilon(1e-12));
  for (std::size_t i = 1; i < def.bodies.size(); ++i)
    CHECK((end.bodies[i].x - def.bodies[i].position).norm() <= 1e-14);
}
