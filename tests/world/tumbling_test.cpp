// Bodies that turn far within a step, by stepping: when they hit, and what is left of their energy.
#include <algorithm>
#include <cmath>

#include "tests/catch.h"
#include "tests/collide/random_pose.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

std::vector<double> impactsOf(const World& world) {
  std::vector<double> times;
  for (const Event& event : world.report().events)
    if (event.kind == EventKind::Impact) times.push_back(event.t);
  return times;
}

/// A fast box that tumbles towards a fixed ball of 0.5 m.
WorldDef boxAtBall(Random& random, const char* method, double e) {
  BodyDef peg = ball("peg", 0.5, Vec3::Zero(), e);
  peg.fixed = true;
  BodyDef small = box("small", {0.2, 0.3, 0.25}, {0.0, 1.3, 0.0}, e);
  small.orientation = random.rotation();
  small.velocity = Vec3(0.0, -12.0, 0.0) + random.vector(-1.0, 1.0);
  small.angularVelocity = random.vector(-40.0, 40.0);
  return worldOf(method, 0.15, {peg, small});
}

/// A hollow box of six plates of 4 mm, 0.4 × 0.3 × 0.35 m, and something thrown about in it without
/// gravity: a cylinder, an L of two boxes or a box.
WorldDef thrownInBox(Random& random, int what, double speed, double step) {
  const Vec3 half(0.2, 0.15, 0.175);
  constexpr double kThick = 0.004;
  Compound plates, ell;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vec3 plate = half;
      for (int k = axis + 1; k < 3; ++k) plate[k] += kThick;
      plate[axis] = 0.5 * kThick;
      plates.parts.push_back({Box{plate}, {side * (half[axis] + 0.5 * kThick) * Vec3::Unit(axis)}});
    }
  ell.parts = {{Box{{0.04, 0.01, 0.02}}, {{0.0, -0.02, 0.0}}},
               {Box{{0.01, 0.02, 0.02}}, {{-0.03, 0.01, 0.0}}}};
  const Shape shapes[] = {Cylinder{0.03, 0.05}, ell, Box{{0.03, 0.025, 0.035}}};
  BodyDef walls = box("walls", {1.0, 1.0, 1.0}, Vec3::Zero(), 0.8, 0.3);
  walls.shape = plates;
  walls.fixed = true;
  BodyDef thrown = box("thrown", {1.0, 1.0, 1.0}, {0.03, 0.02, -0.03}, 0.8, 0.3);
  thrown.shape = shapes[what];
  thrown.velocity = speed * random.rotation()._transformVector(Vec3::UnitX());
  thrown.angularVelocity = random.vector(-30.0, 30.0);
  WorldDef def = worldOf("stepping", 1.0 / speed, {walls, thrown});
  def.gravity.setZero();
  def.stepping.step = step;
  return def;
}

}  // namespace

// Oracle: by construction. Of all the plates near a body it strikes one or two at a time; taken
// for a crowd it was struck by all of them as a step began, turned through a plate and left.
TEST_CASE("what is thrown about in a closed box stays in it, and every blow takes energy") {
  double farthest = 0.0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    const double step = 1.0 / (seed % 4 < 2 ? 30.0 : 240.0), speed = seed % 2 == 0 ? 5.0 : 40.0;
    World world(thrownInBox(random, seed % 3, speed, step));
    const double end = world.model().def.duration;
    for (int k = 1; k <= 20; ++k) {
      const double t = k * end / 20;
      world.advance(t);
      farthest = std::max(farthest, world.sample(t).bodies[1].x.cwiseAbs().maxCoeff());
    }
    const Certificate& books = world.report().certificate;
    CAPTURE(seed);
    CHECK(farthest < 0.2);
    CHECK(books.energy_lost_impact >= 0.0);
    CHECK(books.energy_lost_friction >= 0.0);
    CHECK(books.max_penetration < 1e-9);
    CHECK(world.report().disagreements.empty());
  }
  WARN("thrown about in a box: measured " << farthest << " m from its middle at most");
}

// Oracle: closed form. A millimetre above the edge of a box: along the normals of its flank what
// comes seems to meet it, and nothing ever touches.
TEST_CASE("what flies past without touching goes on as it was") {
  for (const double spin : {0.0, 3.0})
    for (const double speed : {3.0, 17.3})
      for (const double step : {1.0 / 30.0, 1.0 / 240.0}) {
        BodyDef ridge = box("ridge", {0.2, 0.2, 2.0}, {0.0, -std::sqrt(0.02), 0.0});
        ridge.orientation = Eigen::AngleAxisd(0.25 * 3.14159265358979323846, Vec3::UnitZ());
        ridge.fixed = true;
        BodyDef flies = ball("flies", 0.2, {-2.0, 0.201, 0.0});
        flies.velocity = {speed, 0.0, 0.0};
        flies.angularVelocity = {0.0, 0.0, spin};
        WorldDef def = worldOf("stepping", 4.0 / speed, {ridge, flies});
        def.gravity.setZero();
        def.stepping.step = step;
        World world(def);
        world.advance(def.duration);
        CAPTURE(spin, speed, step);
        CHECK(world.sample(def.duration).bodies[1].v == flies.velocity);
        CHECK(world.report().events.empty());
      }
}

// Oracle: the exact method, and energy.
TEST_CASE("a box that tumbles hits when exact says, however long the step, and keeps its energy") {
  int several = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Random random(seed), same(seed);
    const WorldDef def = boxAtBall(random, "stepping", 1.0);
    World world(def), exact(boxAtBall(same, "exact", 1.0));
    world.advance(def.duration);
    exact.advance(def.duration);
    const std::vector<double> hits = impactsOf(world), truth = impactsOf(exact);
    CAPTURE(seed, hits, truth);
    REQUIRE(hits.size() == truth.size());
    several += hits.size() > 1 ? 1 : 0;
    for (std::size_t k = 0; k < hits.size(); ++k)
      CHECK(std::abs(hits[k] - truth[k]) < 1e-12);                   // measured 8e-15
    CHECK(world.report().certificate.energy_balance_error < 1e-12);  // measured 1e-15
  }
  CHECK(several >= 5);
}

// Oracle: conservation. A spring pulls a ball onto a box that spins in flight: its corners carry
// the ball about, and lifting it out of them at the ends of steps gives spin, 5.1e-3 kg m²/s, which
// the certificate owns up to: all about one axis. Measured 1.5e-13 relative; allowed 1e-9.
TEST_CASE("spin that lifting gives bodies in flight stands in the certificate") {
  BodyDef cube = box("cube", {0.2, 0.2, 0.2}, Vec3::Zero(), 0.0, 0.5);
  cube.angularVelocity = {0.0, 0.0, 15.0};
  BodyDef round = ball("round", 0.1, {0.21, 0.02, 0.0}, 0.0, 0.5);
  round.mass = 4.0;
  round.velocity = {-1.0, 0.0, 0.0};
  WorldDef def = worldOf("stepping", 0.5, {cube, round});
  def.gravity.setZero();
  def.forces = {Spring{.a = 0, .b = 1, .stiffness = 2000.0, .rest = 0.1}};
  World world(def);
  constexpr double kMasses[] = {8.0, 4.0}, kInertias[] = {8.0 * 0.04 / 6.0, 0.4 * 4.0 * 0.01};
  const auto spinAt = [&](double t) {
    world.advance(t);
    const Sample now = world.sample(t);
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < 2; ++i)
      sum +=
          kMasses[i] * now.bodies[i].x.cross(now.bodies[i].v) + kInertias[i] * now.bodies[i].omega;
    return sum;
  };
  const Vec3 start = spinAt(0.0);
  double off = 0.0;
  for (int k = 1; k <= 120; ++k) off = std::max(off, (spinAt(k / 240.0) - start).norm());
  const double told = world.report().certificate.spin_added_repair;
  CAPTURE(off, told);
  CHECK(off > 1e-3);
  CHECK(off == Approx(told).epsilon(1e-9));
}
