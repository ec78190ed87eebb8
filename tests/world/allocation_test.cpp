// A step of `stepping` allocates nothing once warm.
#include "tests/allocations.h"
#include "tests/catch.h"
#include "tests/world/joints.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

/// How much twenty steps allocate, after a hundred. A twin has gone the same way before: what keeps
/// its forces may ask a solver for others of that size in the last steps only.
long allocatedBy(const WorldDef& def) {
  const double h = def.stepping.step;
  const auto go = [h](World& world, int from, int to) {
    for (int k = from; k <= to; ++k) world.advance(k * h);
  };
  World twin(def), world(def);
  go(twin, 1, 120);
  go(world, 1, 100);
  const long before = test::allocations;
  go(world, 101, 120);
  return test::allocations - before;
}

/// A world of these bodies without an end.
WorldDef lasting(std::vector<BodyDef> bodies) {
  return worldOf("stepping", 1e6, std::move(bodies));
}

WorldDef hingedPendulum() {
  WorldDef def = lasting({bar("bar", 1.0, 2.0, Vec3::Zero(), 1.0)});
  def.joints = {hinge(0, kNoBody, Vec3::Zero())};
  return def;
}

WorldDef linkage() {
  WorldDef def = lasting({});
  addFourBars(def);
  return def;
}

/// Two islands that take turns in the memory of one: a linkage, and a pendulum beside it.
WorldDef linkageAndPendulum() {
  const Vec3 top(0.0, 0.0, 2.0);
  WorldDef def = linkage();
  def.bodies.push_back(bar("bar", 1.0, 2.0, top, 1.0));
  def.joints.push_back(hinge(3, kNoBody, top));
  return def;
}

/// A cart that slides down to the end of its rail, and a bob that swings on a rope below it.
WorldDef cartAndBob() {
  const Vec3 bob(0.3, -0.6, 0.0);
  WorldDef def = lasting({ball("cart", 0.1, Vec3::Zero()), ball("bob", 0.1, bob)});
  def.joints = {{.name = "rail",
                 .kind = JointKind::Slider,
                 .a = 0,
                 .axis = {1.0, -1.0, 0.0},
                 .lo = -0.05,
                 .hi = 0.05},
                {.name = "rope",
                 .kind = JointKind::Distance,
                 .a = 1,
                 .b = 0,
                 .anchorA = bob,
                 .anchorB = Vec3::Zero(),
                 .lo = 0.1,
                 .hi = 0.68}};
  return def;
}

/// A box on a rough floor, held by a ball joint at an upper corner.
WorldDef heldBox() {
  WorldDef def =
      lasting({ground(0.0, 0.3), box("box", {0.5, 0.5, 0.5}, {0.0, 0.25, 0.0}, 0.0, 0.3)});
  const Vec3 corner(0.25, 0.5, 0.25);
  def.joints = {
      {.name = "held", .kind = JointKind::Ball, .a = 1, .anchorA = corner, .anchorB = corner}};
  return def;
}

}  // namespace

TEST_CASE("stepping: a warm step allocates nothing, at rest or in motion") {
  for (const bool bonded : {false, true})
    for (const auto& [speed, pull] : {std::pair(0.0, 0.0), {0.1, 0.0}, {0.0, 0.1}}) {
      CAPTURE(bonded, speed, pull);
      CHECK(allocatedBy(stackOf(4, 5, 1, bonded, speed, pull)) == 0);
    }
  for (const double friction : {0.0, 0.3}) {
    WorldDef rolling = worldOf("stepping", 10.0, {ground(0.0, friction)});
    rolling.bodies.push_back(ball("ball", 0.1, {0.0, 0.1, 0.0}, 0.0, friction));
    rolling.bodies[1].velocity = {1.0, 0.0, 0.0};
    rolling.gravity.x() = 0.1;
    CAPTURE(friction);
    CHECK(allocatedBy(rolling) == 0);
  }
}

TEST_CASE("stepping: a warm step allocates nothing where joints hold bodies") {
  const std::pair<const char*, WorldDef> scenes[] = {
      {"hinged pendulum", hingedPendulum()},
      {"chain of 20 links that hangs", chainOf("stepping", 20, 10.0, 0.0)},
      {"chain of 20 links that swings", chainOf("stepping", 20, 10.0, 0.5)},
      {"four-bar linkage", linkage()},
      {"linkage and pendulum", linkageAndPendulum()},
      {"slider and distance joint with limits", cartAndBob()},
      {"box held by a ball joint that also touches the floor", heldBox()},
  };
  for (const auto& [name, def] : scenes) {
    CAPTURE(name);
    CHECK(allocatedBy(def) == 0);
  }
}
