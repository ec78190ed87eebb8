// A slope that looks another way: no direction of the world is better than another.
#include <cmath>
#include <numbers>

#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

// Oracle: closed form. With a millionth less friction than rolling needs, (2/7) tan(theta), a ball
// slips from the start:  v = g (sin(theta) − mu cos(theta)) t,  omega = 5 mu g cos(theta) t/(2 r).
// Measured 8e-16 in both, allowed 1e-13.
TEST_CASE("a ball that almost rolls slips as it should on a slope that faces any way") {
  const double turned = GENERATE(0.0, 41.7, 137.0) * std::numbers::pi / 180.0;
  const double theta = std::numbers::pi / 6.0, r = 1e-3, t = 0.1, g = 9.81;
  const double mu = 2.0 / 7.0 * std::tan(theta) * (1.0 - 1e-6);
  const Vec3 n(std::sin(theta) * std::cos(turned), std::cos(theta),
               std::sin(theta) * std::sin(turned));
  WorldDef def = worldOf("exact", t, {ground(0.0, mu), ball("ball", r, r * n, 0.0, mu)});
  def.bodies[0].shape = HalfSpace{n, 0.0};
  World world(def);
  const BodySample end = run(world).bodies[1];
  const double v = g * (std::sin(theta) - mu * std::cos(theta)) * t;
  const double omega = 2.5 * mu * g * std::cos(theta) * t / r;
  CAPTURE(turned, end.v.norm() / v - 1.0, end.omega.norm() / omega - 1.0);
  CHECK(std::abs(end.v.norm() / v - 1.0) < 1e-13);
  CHECK(std::abs(end.omega.norm() / omega - 1.0) < 1e-13);
}

// Oracle: closed form, before anything has moved. A block at 45 degrees slips from the start: it is
// carried by m g cos(theta) and braked by mu times that, each corner inside its cone. Measured
// 2e-15, allowed 1e-12.
TEST_CASE("exact: a block that slips has the forces of a slip from the first instant on") {
  const double turned = GENERATE(0.0, 41.7) * std::numbers::pi / 180.0, mu = 0.5, g = 9.81;
  const Vec3 n(std::sin(std::numbers::pi / 4.0) * std::cos(turned),
               std::cos(std::numbers::pi / 4.0),
               std::sin(std::numbers::pi / 4.0) * std::sin(turned));
  WorldDef def = worldOf("exact", 1.0, {ground(0.0, mu)});
  def.bodies[0].shape = HalfSpace{n, 0.0};
  def.bodies.push_back(box("block", {0.2, 0.2, 0.2}, 0.1 * n, 0.0, mu));
  def.bodies[1].orientation =
      fromAxisAngle(Vec3::UnitY().cross(n).normalized(), 0.25 * std::numbers::pi);
  World world(def);
  world.advance(0.0);
  const Sample sample = world.sample(0.0);
  REQUIRE(sample.contacts.size() == 4);
  const double carried = 8.0 * g * std::cos(std::numbers::pi / 4.0);
  Vec3 sum = Vec3::Zero();
  for (const ContactSample& c : sample.contacts) {
    const double push = c.force.dot(n);
    CAPTURE(push, (c.force - push * n).norm() - mu * push);
    CHECK((c.force - push * n).norm() < mu * push + 1e-12 * carried);
    sum += c.force;
  }
  CHECK(std::abs(sum.dot(n) / carried - 1.0) < 1e-12);
  CHECK(std::abs((sum - sum.dot(n) * n).norm() / (mu * carried) - 1.0) < 1e-12);
}
