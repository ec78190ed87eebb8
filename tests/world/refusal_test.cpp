// Worlds that cannot be are refused, with the place in the definition.
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
