// Fixed bodies that move on and crush what is between them: every method ends in words.
#include <cmath>

#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

/// Two crates on a floor between a wall and a press that comes at 1 m/s and meets resistance at
/// 0.9 s.
WorldDef press(const std::string& method, double friction, double restitution) {
  WorldDef def;
  def.method = method;
  def.duration = 2.0;
  def.bodies = {ground(0.0, friction), box("wall", {0.2, 1.0, 1.0}, {1.0, 0.5, 0.0}, 0.0, friction),
                box("press", {0.2, 0.5, 0.5}, {-0.5, 0.3, 0.0}, 0.0, friction),
                box("crate", {0.2, 0.2, 0.2}, {0.2, 0.1, 0.0}, 0.0, friction),
                box("crate2", {0.2, 0.2, 0.2}, {0.5, 0.1, 0.0}, 0.0, friction)};
  for (BodyDef& body : def.bodies) body.restitution = restitution;
  def.bodies[1].fixed = def.bodies[2].fixed = true;
  def.bodies[2].velocity = {1.0, 0.0, 0.0};
  return def;
}

constexpr double kSlant = 0.3;  // [rad]

/// A ball of 0.1 m between plates that close in on it at 2.4 m/s and lean towards each other.
WorldDef jaws(const std::string& method) {
  WorldDef def;
  def.method = method;
  def.duration = 0.3;
  def.gravity.setZero();
  def.bodies = {box("left", {0.2, 1.0, 1.0}, {-0.5, 0.0, 0.0}),
                box("right", {0.2, 1.0, 1.0}, {0.5, 0.0, 0.0}), ball("ball", 0.1, Vec3::Zero())};
  def.bodies[0].fixed = def.bodies[1].fixed = true;
  def.bodies[0].orientation = fromAxisAngle(Vec3::UnitZ(), kSlant);
  def.bodies[1].orientation = fromAxisAngle(Vec3::UnitZ(), -kSlant);
  def.bodies[0].velocity = {1.2, 0.0, 0.0};
  def.bodies[1].velocity = {-1.2, 0.0, 0.0};
  return def;
}

}  // namespace

// Oracle: 0.9 s by hand; until then all is obeyed. Measured within 5e-3 s, a step.
TEST_CASE("what is pressed against a wall ends the run, and words say who and when") {
  for (const char* method : {"stepping", "course"}) {
    for (const auto& [friction, restitution] : {std::pair(0.0, 0.0), {0.5, 0.0}, {0.5, 0.4}}) {
      CAPTURE(method, friction, restitution);
      World world(press(method, friction, restitution));
      world.advance(2.0);
      const Report& report = world.report();
      CAPTURE(report.reason);
      REQUIRE(report.stopped);
      const std::string when = restitution > 0.0 ? "at t = " : "at t = 0.9";
      CHECK(report.reason.find("is crushed by \"wall\" and \"press\" " + when) !=
            std::string::npos);
      CHECK(report.certificate.max_penetration < 1e-6);
      CHECK(report.certificate.energy_lost_impact < 1e3);
    }
  }
}

// Oracle: there is room to give way. A ball between closing jaws that slant by 0.3 rad is squeezed
// out if it is smooth, or if friction is less than the tangent of their slant, 0.309; else it
// jams, and no force holds the jaws.
TEST_CASE("what can give way is not crushed, unless friction holds it") {
  for (const char* method : {"exact", "stepping", "course"}) {
    for (const double e : {0.0, 0.5})
      for (const double mu : {0.0, 0.3, 0.32, 0.8}) {
        CAPTURE(method, e, mu);
        WorldDef def = jaws(method);
        for (BodyDef& body : def.bodies) {
          body.friction = mu;
          body.restitution = e;
        }
        World world(def);
        world.advance(def.duration);
        const Report& report = world.report();
        CAPTURE(report.reason);
        REQUIRE(report.stopped == (mu > std::tan(kSlant)));
        CHECK(report.certificate.max_penetration < 1e-9);
        if (report.stopped) {
          CHECK(report.reason.find("\"ball\" is crushed by \"left\" and \"right\"") == 0);
          CHECK(std::abs(report.certificate.energy_lost_impact) < 1e3);
        } else {
          CHECK(world.sample(def.duration).bodies[2].x.norm() > 0.02);
        }
      }
  }
}

// A box that turns into a corner of walls which slant: friction jams it as it goes round.
TEST_CASE("a box that a paddle jams in a drum ends the run") {
  constexpr int kSides = 16;
  WorldDef def = worldOf("stepping", 1.0, {});
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2.0 * kPi * k / kSides;
    def.bodies.push_back(box("side." + std::to_string(k), {0.1, 0.25, 1.2},
                             {0.55 * std::cos(angle), 0.55 * std::sin(angle), 0.0}, 0.3, 1.0));
    def.bodies.back().orientation = fromAxisAngle(Vec3::UnitZ(), angle);
    def.bodies.back().fixed = true;
  }
  def.bodies.push_back(box("paddle", {0.825, 0.04, 0.8}, Vec3::Zero(), 0.3, 1.0));
  def.bodies.back().fixed = true;
  def.bodies.back().angularVelocity = {0.0, 0.0, 7.27};
  def.bodies.push_back(box("it", {0.1426, 0.114, 0.1711}, {0.038, -0.18, -0.25}, 0.3, 1.0));
  World world(def);
  world.advance(def.duration);
  const Report& report = world.report();
  CAPTURE(report.reason, report.certificate.steps);
  CHECK(report.reason.find("\"it\" is crushed by ") == 0);
  CHECK(report.certificate.max_penetration < 1e-9);
  CHECK(std::abs(report.certificate.energy_lost_impact) < 1e3);
}
