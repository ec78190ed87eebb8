// Worlds whose contacts ride along with what they carry: forces stay while their problem is the
// same, and no longer.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

// Oracle: closed form, a steady motion, and the weights above each layer. Measured 1.6e-13 m,
// allowed 1e-12; forces to 3e-16, allowed 1e-12.
TEST_CASE("stepping: a stack that drifts for ten seconds keeps its shape and its forces") {
  constexpr double kSpeed = 0.1, kTime = 10.0;
  WorldDef def = stackOf(3, 4, 1, true, kSpeed);
  def.duration = kTime;
  World world(def);
  const Sample end = run(world);
  double way = 0.0, floor = 0.0;
  for (std::size_t i = 1; i < end.bodies.size(); ++i) {
    const Vec3 due = def.bodies[i].position + Vec3(kSpeed * kTime, 0.0, 0.0);
    way = std::max(way, (end.bodies[i].x - due).norm());
  }
  for (const ContactSample& c : end.contacts)
    if (c.b == 0) floor += c.force.y();
  const double weight = 12.0 * def.gravity.norm();
  CAPTURE(way, floor / weight - 1.0);
  CHECK(way < 1e-12);
  CHECK(std::abs(floor / weight - 1.0) < 1e-12);
}

// Oracle: a box stays level until its centre is past the edge, and then tips over it. Measured
// below 1e-16 and 3.7 rad/s, allowed 1e-12 and asked 0.5.
TEST_CASE("stepping: a box that slides off a smooth block stays level up to its edge") {
  constexpr double kSpeed = 0.7, kEdge = 1.0;
  BodyDef block = box("block", {2.0, 1.0, 1.0}, {0.0, -0.5, 0.0});
  block.fixed = true;
  BodyDef sliding = box("sliding", {0.5, 0.3, 0.4}, {0.2, 0.15, 0.0});
  sliding.velocity = {kSpeed, 0.0, 0.0};
  World world(worldOf("stepping", 2.0, {block, sliding}));
  const double past = (kEdge - 0.2) / kSpeed;
  world.advance(0.99 * past);
  const double leant = world.sample(0.99 * past).bodies[1].q.vec().norm();
  world.advance(past + 0.3);
  const double tips = -world.sample(past + 0.3).bodies[1].omega.z();
  CAPTURE(leant, tips);
  CHECK(leant < 1e-12);
  CHECK(tips > 0.5);
}

// Oracle: closed form. The forces on what slides along its line are the same in every step, and are
// asked for again only where their rounding adds up: measured in 1 and 2 of 144 steps, allowed 8;
// the residual stays below 1e-13, the speed within 3e-14 m/s, allowed 1e-12. Two boxes on each
// other slide as one.
TEST_CASE("stepping: what slides on along its line keeps its forces, and obeys them") {
  constexpr double kMu = 0.5, kTime = 0.6;
  const bool two = GENERATE(false, true), down = GENERATE(false, true);
  const double tilt = down ? std::numbers::pi / 6.0 : 0.0;
  const Vec3 up(std::sin(tilt), std::cos(tilt), 0.0), along(up.y(), -up.x(), 0.0);
  BodyDef floor = ground(0.0, kMu);
  floor.shape = HalfSpace{up, 0.0};
  WorldDef def = worldOf("stepping", kTime, {floor});
  for (int k = 0; k <= two; ++k) {
    BodyDef& brick = def.bodies.emplace_back(
        box("brick", {0.3, 0.1, 0.2}, (0.05 + 0.1 * k) * up, 0.0, k == 0 ? kMu : 2.0));
    brick.orientation = Quat(Eigen::AngleAxisd(-tilt, Vec3::UnitZ()));
    brick.velocity = 3.0 * along;
  }
  World world(def);
  const Sample end = run(world);
  const double speed = 3.0 + kTime * 9.81 * (std::sin(tilt) - kMu * std::cos(tilt));
  const Certificate& books = world.report().certificate;
  CAPTURE(two, down, books.islands_solved, books.max_complementarity);
  for (std::size_t i = 1; i < end.bodies.size(); ++i)
    CHECK((end.bodies[i].v - speed * along).norm() < 1e-12);
  CHECK(books.islands_solved <= 8);
  CHECK(books.max_complementarity < 1e-13);
}

// Oracle: closed form. A ball that rolls on asks what it asked: measured in 2 steps of 240, allowed
// 8; its place to 2e-15 m, allowed 1e-12.
TEST_CASE("stepping: a ball that rolls on is solved once, and its speed gathers no rounding") {
  WorldDef def =
      worldOf("stepping", 1.0, {ground(0.0, 0.5), ball("ball", 0.1, {0.0, 0.1, 0.0}, 0.0, 0.5)});
  def.bodies[1].velocity = {2.0, 0.0, 0.0};
  def.bodies[1].angularVelocity = {0.0, 0.0, -20.0};
  World world(def);
  const Sample end = run(world);
  CHECK((end.bodies[1].x - Vec3(2.0, 0.1, 0.0)).norm() < 1e-12);
  CHECK(world.report().certificate.islands_solved <= 8);
}

// Oracle: a rolling ball circles at 2/7 of the turntable's angular velocity, or turns in its place.
// Measured 1.3e-6 m after a circle at a step of 1 ms, allowed 5e-6; in its place 2.2e-19 m, allowed
// 1e-12.
TEST_CASE("stepping: balls circle on a turntable, or turn in their place", "[figures]") {
  const double Omega = 2.0, period = 2.0 * std::numbers::pi / (2.0 / 7.0 * Omega);
  const Vec3 x(1.0, 0.1, 0.0);
  const auto wayOf = [&](const Vec3& velocity) {
    WorldDef def =
        worldOf("stepping", period, {turntable(Omega, 1.0), ballOnTurntable(Omega, x, velocity)});
    def.stepping.step = 1e-3;
    World world(def);
    return (run(world).bodies[1].x - x).norm();
  };
  const double circle = wayOf({0.3, 0.0, 0.2}), place = wayOf(Vec3::Zero());
  WARN("turntable by stepping closes to " << circle << " m, in its place to " << place << " m");
  CHECK(circle < 5e-6);
  CHECK(place < 1e-12);
}

// Oracle: bit equality. A stack that lands, stands for ten seconds, and is looked at from one call
// and from a call for each instant, at ends of steps and between them.
TEST_CASE("stepping: one call tells of every instant what a call for each tells") {
  constexpr double kTime = 10.0;
  WorldDef def = stackOf(2, 3, 1, false, 0.0);
  for (BodyDef& body : def.bodies)
    if (!body.fixed) body.position.y() += 0.01;
  def.duration = kTime;
  World once(def), often(def);
  once.advance(kTime);
  for (int k = 1; k <= 700; ++k) {
    const double t = kTime * k / 700.0;
    often.advance(t);
    const Sample p = once.sample(t), q = often.sample(t);
    REQUIRE(p.bodies.size() == q.bodies.size());
    for (std::size_t i = 0; i < p.bodies.size(); ++i) {
      const BodySample &a = p.bodies[i], &b = q.bodies[i];
      CHECK((a.x == b.x && a.q.coeffs() == b.q.coeffs() && a.v == b.v && a.omega == b.omega));
    }
    REQUIRE(p.contacts.size() == q.contacts.size());
    for (std::size_t i = 0; i < p.contacts.size(); ++i)
      CHECK(p.contacts[i].force == q.contacts[i].force);
  }
  CHECK(once.report().certificate.audited_steps == often.report().certificate.audited_steps);
  CHECK(often.report().certificate.steps == 2403);  // 2400, and what the landing divides
  CHECK(once.report().certificate.steps == 2403);
}
