// What rolls and slides, and what rolls under it: closed forms, at a cost that does not grow with
// how fast it turns.
#include <algorithm>
#include <cmath>

#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

/// The part of a turn [rad] by which two attitudes differ.
double turnApart(const Quat& p, const Quat& q) {
  return 2.0 * (p.conjugate() * q).vec().norm();
}

}  // namespace

// Oracle: closed form. Down a slope at the angle s a ball that rolls goes
//   x = v t + ½ a t²,   a = g sin s/(1 + 2/5),   turned by x/r about the level axis across.
// At the end it turns at 200 rad/s. Measured 1.4e-12 m of 124 and 2.2e-11 rad of 1,235 after 985
// and 1,073 evaluations; without the turn that is taken off, 67,000.
TEST_CASE("a ball rolls down a slope for ten seconds in a thousand evaluations") {
  const double s = 0.3, r = 0.1, T = 10.0;
  const Vec3 n(std::sin(s), std::cos(s), 0.0), down(std::cos(s), -std::sin(s), 0.0);
  for (const double v : {0.0, 2.0}) {
    WorldDef def = worldOf("exact", T, {ground(0.0, 0.5), ball("ball", r, r * n, 0.0, 0.5)});
    def.bodies[0].shape = HalfSpace{n, 0.0};
    def.bodies[1].velocity = v * down;
    def.bodies[1].angularVelocity = n.cross(v * down) / r;
    World world(def);
    const BodySample end = run(world).bodies[1];
    const double way = v * T + 0.5 * 9.81 * std::sin(s) / 1.4 * T * T;
    const Quat turned = fromAxisAngle(n.cross(down), way / r);
    CAPTURE(v, (end.x - r * n - way * down).norm(), turnApart(end.q, turned));
    CHECK((end.x - r * n - way * down).norm() < 1e-10);
    CHECK(turnApart(end.q, turned) < 1e-9);
    CHECK(world.report().certificate.evaluations < 2000);
  }
}

// Oracle: the same motion seen in short stretches, in each of which the ball turns little. A ball
// that slides aside while it spins about two axes curves until it rolls. Measured 8e-16 m,
// 4e-14 rad.
TEST_CASE("a ball that spins about other axes than it rolls about turns as in short stretches") {
  WorldDef def = worldOf("exact", 1.0, {ground(0.0, 0.3), ball("ball", 0.1, {0, 0.1, 0}, 0, 0.3)});
  def.bodies[1].velocity = {1.0, 0.0, 0.5};
  def.bodies[1].angularVelocity = {20.0, 30.0, -5.0};
  World one(def);
  const BodySample end = run(one).bodies[1];
  // The rest of the motion begins anew every hundredth of a second.
  for (int k = 0; k < 100; ++k) {
    WorldDef part = def;
    part.duration = 0.01;
    World world(part);
    const BodySample next = run(world).bodies[1];
    def.bodies[1].position = next.x;
    def.bodies[1].orientation = next.q;
    def.bodies[1].velocity = next.v;
    def.bodies[1].angularVelocity = next.omega;
  }
  const BodyDef& last = def.bodies[1];
  CAPTURE((end.x - last.position).norm(), turnApart(end.q, last.orientation));
  CHECK((end.x - last.position).norm() < 1e-12);
  CHECK(turnApart(end.q, last.orientation) < 1e-11);
}

// Oracle: two methods agree. A board on two rollers that turn against each other slides to and fro,
// level all the time: their spin turns no normal. Measured 1e-6 m along, by the second order of a
// step, 4e-14 m of height; where the spin led the normals round, it climbed 0.05 and 0.4 mm.
TEST_CASE("stepping: a board on rollers stays level, however fast they spin") {
  const double spin = GENERATE(20.0, 200.0);
  const Shape shape = GENERATE(as<Shape>(), Sphere{0.1}, Cylinder{0.1, 0.5}, Capsule{0.1, 0.5},
                               Ellipsoid{{0.1, 0.2, 0.1}});
  WorldDef def = worldOf("stepping", 1.0, {});
  for (const double x : {-0.5, 0.5}) {
    for (const double z : {-0.3, 0.3}) {
      BodyDef& roller = def.bodies.emplace_back();
      roller.name = "roller." + std::to_string(def.bodies.size());
      roller.shape = shape;
      roller.fixed = true;
      roller.friction = 0.2;
      roller.position = {x, 0.0, z};
      roller.orientation = fromAxisAngle(Vec3::UnitX(), 0.5 * std::numbers::pi);
      roller.angularVelocity = {0.0, 0.0, std::copysign(spin, x)};
    }
  }
  def.bodies.push_back(box("board", {3.0, 0.05, 0.8}, {0.2, 0.125, 0.0}, 0.0, 0.2));
  WorldDef exact = def;
  exact.method = "exact";
  World one(def), other(exact);
  const Vec3 x = run(one).bodies.back().x, expected = run(other).bodies.back().x;
  CAPTURE(spin, shape.index(), x.x() - expected.x(), x.y() - 0.125);
  CHECK(std::abs(x.x() - expected.x()) < 1e-5);
  CHECK(std::abs(x.y() - 0.125) < 1e-11);
}

// Oracle: closed form. A plank of 2 kg on smooth ground is pulled from under a ball of 1 kg that
// rolls on it: it gains F/(M + 2m/7), the ball 2/7 of that. Only the first step errs by more than
// the square of a step: measured 7.6e-6 m, allowed 4e-5, of a way of 0.28 m, and a quarter in steps
// half as long; where rounding told whether one leads the other round, 1.4e-3 m and a half.
TEST_CASE("stepping: a plank is pulled from under a ball that rolls on it") {
  const double turned = GENERATE(0.0, 0.7);
  constexpr double kTime = 0.8, kForce = 2.0;
  const auto off = [&](double h) {
    const Quat turn = fromAxisAngle(Vec3::UnitY(), turned);
    BodyDef plank = box("plank", {4.0, 0.1, 1.0}, {0.0, 0.05, 0.0}, 0.0, 1.0);
    plank.mass = 2.0;
    plank.orientation = turn;
    const BodyDef rolls = ball("ball", 0.1, {0.0, 0.2, 0.0}, 0.0, 1.0);
    WorldDef def = worldOf("stepping", kTime, {ground(), plank, rolls});
    const Vec3 along = turn * Vec3::UnitX();
    def.forces = {UniformWind{1, kForce * along}};
    def.stepping.step = h;
    World world(def);
    const Sample end = run(world);
    const double way = 0.5 * kTime * kTime * kForce / (2.0 + 2.0 / 7.0);
    CHECK((end.bodies[2].x - rolls.position - 2.0 / 7.0 * way * along).norm() < 4e-5);
    return (end.bodies[1].x - plank.position - way * along).norm();
  };
  const double whole = off(1.0 / 240.0), half = off(1.0 / 480.0);
  CAPTURE(turned, whole, half);
  CHECK(whole < 4e-5);
  CHECK(whole > 3.5 * half);
}

// Oracle: geometry. A ball of radius r touches the edge of a step of height h when it stands at
// √(r² − (r − h)²) before it, and leaves the floor there as it climbs. Measured 3e-16 m by exact,
// 2e-12 m by course.
TEST_CASE("a ball that climbs a step leaves the floor where it meets the step") {
  constexpr double kRadius = 0.1, kHeight = 0.03;
  BodyDef step = box("step", {2.0, kHeight, 1.0}, {1.0, 0.5 * kHeight, 0.0}, 0.0, 20.0);
  step.fixed = true;
  BodyDef rolls = ball("ball", kRadius, {-0.3, kRadius, 0.0}, 0.0, 20.0);
  rolls.velocity = {0.85, 0.0, 0.0};
  rolls.angularVelocity = {0.0, 0.0, -0.85 / kRadius};
  const char* const method = GENERATE("exact", "course");
  World world(worldOf(method, 0.4, {ground(0.0, 20.0), step, rolls}));
  world.advance(0.4);
  const std::vector<Event>& events = world.report().events;
  const auto parts = std::find_if(events.begin(), events.end(), [](const Event& event) {
    return event.kind == EventKind::Separate && event.b == 0;
  });
  CAPTURE(method);
  REQUIRE(parts != events.end());
  const double low = kRadius - kHeight;
  CHECK(std::abs(parts->p.x() + std::sqrt(kRadius * kRadius - low * low)) < 1e-9);
  CHECK(std::abs(parts->p.y()) < 1e-9);
}
