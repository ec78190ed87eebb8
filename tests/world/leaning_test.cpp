// What leans on another body while a third point hits: the methods tell the same motion.
#include <numbers>

#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

// Oracle: two methods agree. A box that hangs slack on a ball slides on an edge until its face
// falls on the ground, which gives all back. Measured 7.5e-10 m, allowed 1e-6; where the rounding
// of a speed told whether the edge takes part in the blow, 0.07 m.
TEST_CASE("a box that falls from an edge onto its face goes on alike by two methods") {
  constexpr double kTime = 1.0, kDegree = std::numbers::pi / 180.0;
  BodyDef falls = box("box", {0.340, 0.155, 0.357},
                      {-0.056677302194517346, 0.3740204027915961, 0.060337955440159075}, 1.0, 1.0);
  falls.mass = 0.5;
  falls.velocity = {0.3787420170640825, -0.9113356601119724, 0.8925642046705522};
  falls.angularVelocity = {-2.1732461191166266, -2.7568234829171647, 0.7779454839246611};
  falls.orientation = fromAxisAngle(
      Vec3(-0.7976676028392642, -0.12143950579914961, 0.38596618722963116).normalized(),
      42.3 * kDegree);
  BodyDef other = ball("other", 0.15,
                       {-0.09999058909552322, 1.2205135876597275, 0.07201471278563884}, 1.0, 1.0);
  other.shape = Capsule{0.150, 0.268};
  other.velocity = {0.43178565679086756, -0.3329145305916663, -0.9591225084892181};
  other.angularVelocity = {1.5226854589491587, 3.637604113663002, -3.1561100843042524};
  other.orientation =
      fromAxisAngle(Vec3(0.7111566304374891, 1.155354466141889, -0.5814591451096353).normalized(),
                    124.7 * kDegree);
  WorldDef def = worldOf("exact", kTime, {ground(1.0, 1.0), falls, other});
  def.joints.push_back({.name = "rope",
                        .kind = JointKind::Distance,
                        .a = 1,
                        .b = 2,
                        .anchorA = falls.position,
                        .anchorB = other.position,
                        .hi = 1.017});
  World exact(def);
  const Vec3 expected = run(exact).bodies[1].x;
  def.method = "course";
  def.course.integrator = "dopri5";
  def.course.step = 5e-4;
  World course(def);
  const Vec3 x = run(course).bodies[1].x;
  CAPTURE((x - expected).norm());
  CHECK((x - expected).norm() < 1e-6);
}
