// Fixed bodies that move on and crush what is between them: every method ends in words.
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

// Oracle: there is room to give way. A ball between closing jaws that slant is squeezed out.
TEST_CASE("what can give way is not crushed") {
  for (const char* method : {"stepping", "course"}) {
    CAPTURE(method);
    WorldDef def;
    def.method = method;
    def.duration = 0.3;
    def.gravity.setZero();
    def.bodies = {box("left", {0.2, 1.0, 1.0}, {-0.5, 0.0, 0.0}),
                  box("right", {0.2, 1.0, 1.0}, {0.5, 0.0, 0.0}), ball("ball", 0.1, Vec3::Zero())};
    def.bodies[0].fixed = def.bodies[1].fixed = true;
    def.bodies[0].orientation = fromAxisAngle(Vec3::UnitZ(), 0.3);
    def.bodies[1].orientation = fromAxisAngle(Vec3::UnitZ(), -0.3);
    def.bodies[0].velocity = {1.2, 0.0, 0.0};
    def.bodies[1].velocity = {-1.2, 0.0, 0.0};
    World world(def);
    const Sample end = run(world);
    CHECK_FALSE(world.report().stopped);
    CHECK(end.bodies[2].x.norm() > 0.02);
  }
}
