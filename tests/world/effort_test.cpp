// What the exact method follows without toil, and where numbers end.
#include <cmath>
#include <string>

#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

/// A box that turns, on a floor, and one of that mass [kg] about to fall on it.
WorldDef hammered(double heavy, double light) {
  WorldDef def = worldOf("exact", 1.0, {ground(0.0, 0.5)});
  addColumn(def, 2, 0.2, {0.0, 0.1, 0.0}, 0.0, 0.5);
  def.bodies[1].mass = light;
  def.bodies[2].mass = heavy;
  def.bodies[2].position = {0.03, 0.5, 0.01};
  return def;
}

/// A ball on a bar that leads it aslant to a rough floor, where friction locks it.
WorldDef wedge(double side) {
  WorldDef def = worldOf("exact", 1.0, {ground(0.0, 1.5)});
  def.bodies.push_back(ball("ball", 0.1, {0.0, 0.4, 0.0}, 0.0, 1.5));
  const Vec3 anchor(0.0, 0.7, 0.0);
  def.joints = {{.name = "bar",
                 .kind = JointKind::Slider,
                 .a = 1,
                 .b = kNoBody,
                 .anchorA = anchor,
                 .anchorB = anchor,
                 .axis = {-0.34 * side, -0.68, -0.82}}};
  return def;
}

}  // namespace

// Oracle: the floor and the boxes. Forces of 1e22 N on a box of 1 kg round off by 1e6 N, so that
// nothing can be known of it. Measured without the check: 1.6 m of overlap, and exit 0.
TEST_CASE("exact: what rounding drives into each other ends the run in words") {
  World world(hammered(1e21, 1.0));
  run(world);
  const Report& report = world.report();
  CAPTURE(report.reason, report.certificate.max_penetration);
  CHECK(report.stopped);
  CHECK(report.reason.find("masses") != std::string::npos);
  World sound(hammered(1e6, 1.0));
  run(sound);
  CAPTURE(sound.report().reason);
  CHECK_FALSE(sound.report().stopped);
  CHECK(sound.report().certificate.max_penetration < 1e-9);
}

// Oracle: statics. tan of the bar's angle from the vertical is 1.31, less than mu: no force draws
// the ball out again, and none needs to. Measured: residual 3e-13, 3,300 evaluations; with a pull
// out of the floor 3e-9, 13,900, and forces left unsolved.
TEST_CASE("exact: a ball that a bar leads to a floor stays where friction locks it") {
  for (const double side : {1.0, -1.0}) {
    World world(wedge(side));
    const Sample end = run(world);
    const Certificate& books = world.report().certificate;
    CAPTURE(side, books.max_complementarity, books.evaluations, books.energy_balance_error);
    CHECK(books.max_complementarity < 1e-11);
    CHECK(books.evaluations < 6000);
    CHECK(books.energy_balance_error < 1e-12);
    CHECK(std::abs(end.bodies[1].x.y() - 0.1) < 1e-11);
    CHECK(end.bodies[1].v.norm() < 1e-8);
    for (const std::string& note : world.report().notes)
      CHECK(note.find("unsolved") == std::string::npos);
  }
}
