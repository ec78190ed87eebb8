// Worlds that cannot be are refused, with the place in the definition.
#include <limits>
#include <stdexcept>

#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

std::string refusedAt(const WorldDef& def, std::string* why = nullptr) {
  try {
    World world(def);
  } catch (const Refusal& refusal) {
    if (why) *why = refusal.what();
    return refusal.where();
  }
  return "";
}

WorldDef sound() {
  WorldDef def;
  def.method = "course";
  def.bodies = {ground(), ball("ball", 0.1, {0.0, 1.0, 0.0})};
  return def;
}

}  // namespace

TEST_CASE("a world does not advance to what is no instant") {
  World world(sound());
  world.advance(0.1);
  for (const double t :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(world.advance(t), std::invalid_argument);
  CHECK_NOTHROW(world.advance(1e9));  // to its end
}

TEST_CASE("impossible worlds are refused where they are wrong") {
  CHECK(refusedAt(sound()).empty());
  WorldDef def = sound();
  def.bodies.clear();
  CHECK(refusedAt(def) == "bodies");
  def = sound();
  def.bodies[1].mass = -1.0;
  CHECK(refusedAt(def) == "bodies[1].mass");
  def = sound();
  def.bodies[1].mass.reset();
  CHECK(refusedAt(def) == "bodies[1]");
  def = sound();
  def.bodies[1].restitution = 1.5;
  CHECK(refusedAt(def) == "bodies[1].restitution");
  def = sound();
  def.bodies[1].position.y() = std::nan("");
  CHECK(refusedAt(def) == "bodies[1].position");
  def = sound();
  def.bodies[1].inertia = Vec3(1.0, 0.0, 1.0);
  CHECK(refusedAt(def) == "bodies[1].inertia");
  def = sound();
  def.bodies[1].orientation = Quat(0.0, 0.0, 0.0, 0.0);
  CHECK(refusedAt(def) == "bodies[1].orientation");
  def = sound();
  def.bodies[1].shape = Sphere{0.0};
  CHECK(refusedAt(def) == "bodies[1].shape");
  def = sound();
  def.forces = {PointForce{7, Vec3::Zero(), Vec3::UnitX()}};
  CHECK(refusedAt(def) == "forces[0]");
  def = sound();
  def.method = "magic";
  CHECK(refusedAt(def) == "method");
  def = sound();
  def.course.integrator = "rk5";
  CHECK(refusedAt(def) == "course.integrator");
  def = sound();
  def.bodies[0].fixed = false;
  CHECK(refusedAt(def) == "bodies[0].fixed");
  def = sound();
  def.bodies[0].velocity = {0.0, 1.0, 0.0};
  CHECK(refusedAt(def) == "bodies[0].velocity");
}

TEST_CASE("an overlapping start names both bodies and the depth; touching to rounding is fine") {
  WorldDef def = sound();
  def.bodies[1].position.y() = 0.07;
  std::string why;
  CHECK(refusedAt(def, &why) == "bodies[1].position");
  CHECK(why.find("\"ball\" overlaps \"ground\" by 0.03 m") != std::string::npos);
  def.bodies[1].position.y() = 0.1;
  CHECK(refusedAt(def).empty());
  def.bodies[1].position.y() = 0.1 - 1e-15;
  CHECK(refusedAt(def).empty());
}

namespace {

/// A box that hangs from a point of mass, tied there at an anchor that misses its place by so much.
WorldDef tiedTo(const Vec3& miss) {
  WorldDef def = sound();
  const Vec3 place(1.0 / 3.0, 1.0, 0.0);
  def.duration = 0.1;
  def.method = "stepping";
  def.bodies.push_back({.name = "bob", .shape = Particle{}, .mass = 0.2, .position = place});
  def.bodies.push_back({.name = "box",
                        .shape = Box{{0.1, 0.1, 0.1}},
                        .mass = 1.0,
                        .position = place - Vec3(0.0, 0.2, 0.0)});
  def.joints.push_back({.name = "tie",
                        .kind = JointKind::Ball,
                        .a = 3,
                        .b = 2,
                        .anchorA = place + miss,
                        .anchorB = place + miss});
  return def;
}

}  // namespace

// Oracle: bit-equal rerun; the anchor that is told. Places that are turned or thirds of a metre
// have last digits that nobody writes.
TEST_CASE("an anchor on a particle may miss its last digits, and is told how far it is off") {
  const auto endOf = [](const WorldDef& def) {
    World world(def);
    world.advance(def.duration);
    return world.sample(def.duration).bodies[3].x;
  };
  CHECK(endOf(tiedTo({1e-9, -1e-9, 1e-17})) == endOf(tiedTo(Vec3::Zero())));
  std::string why;
  CHECK(refusedAt(tiedTo({0.0, 0.005, 0.0}), &why) == "joints[0].anchor");
  CHECK(why.find("\"bob\" is a particle") != std::string::npos);
  CHECK(why.find("move it by [0, -0.005, 0] m") != std::string::npos);
}

// Oracle: closed form, |(0.3, 0.4, 0)| = 0.5: the size of a velocity, not one of its coordinates.
TEST_CASE("bodies that part at a joint at the start are told how fast") {
  WorldDef def = tiedTo(Vec3::Zero());
  def.bodies[2].velocity = {0.3, 0.4, 0.0};
  std::string why;
  CHECK(refusedAt(def, &why) == "joints[0]");
  CHECK(why.find("they part at 0.5 m/s there") != std::string::npos);
}
