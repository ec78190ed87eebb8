// Bodies that slide or roll from one body onto another that is flush with it.
#include <cmath>
#include <numbers>
#include <string>

#include "sim/world.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

BodyDef slab(const std::string& name, double from, double to, double friction = 0.2) {
  BodyDef def;
  def.name = name;
  def.shape = Box{{0.5 * (to - from), 0.25, 1.0}};
  def.position = {0.5 * (from + to), -0.25, 0.0};
  def.fixed = true;
  def.friction = friction;
  return def;
}

/// Where a body ends that starts on slabs that meet at the given places.
Vec3 endOn(std::initializer_list<double> seams, BodyDef body) {
  WorldDef def;
  def.method = "stepping";
  def.duration = 1.0;
  double from = -3.0;
  for (const double to : seams) {
    def.bodies.push_back(
        slab("slab." + std::to_string(def.bodies.size()), from, to, body.friction));
    from = to;
  }
  def.bodies.push_back(slab("last", from, 3.0, body.friction));
  body.name = "body";
  body.mass = 2.0;
  body.velocity = {1.5, 0.0, 0.1};
  def.bodies.push_back(body);
  World world(def);
  world.advance(def.duration);
  return world.sample(def.duration).bodies.back().x;
}

}  // namespace

// Oracle: symmetry; flush slabs are one slab. On ice, for how a load is shared among the points of
// a face is no matter of physics; a ball has but one. Measured 2.3e-14 m, allowed 1e-9 m, the width
// of a touch.
TEST_CASE("what slides or rolls over a seam of flush bodies goes as over one body") {
  const double turned = GENERATE(0.0, 20.0, 45.0) * std::numbers::pi / 180.0;
  BodyDef body;
  body.orientation = Quat(Eigen::AngleAxisd(turned, Vec3::UnitY()));
  SECTION("a box") {
    body.shape = Box{{0.2, 0.1, 0.15}};
    body.position = {-0.7, 0.1, 0.0};
  }
  SECTION("a ball") {
    body.shape = Sphere{0.2};
    body.friction = 0.2;
    body.position = {-0.7, 0.2, 0.0};
  }
  SECTION("a standing cylinder") {
    body.shape = Cylinder{0.2, 0.2};
    body.position = {-0.7, 0.1, 0.0};
  }
  const Vec3 onOne = endOn({}, body);
  CHECK(onOne.x() > 0.3);
  CHECK((endOn({0.0}, body) - onOne).norm() < 1e-9);
  CHECK((endOn({-0.31, 0.02, 0.17}, body) - onOne).norm() < 1e-9);
}

// Oracle: a step in the floor that is no seam stops what runs into it.
TEST_CASE("a kerb that stands out of the floor is no seam") {
  WorldDef def;
  def.method = "stepping";
  def.duration = 1.0;
  BodyDef kerb = slab("kerb", 0.5, 1.0), box;
  kerb.position.y() = -0.24;  // 1 cm above the floor
  box.name = "box";
  box.shape = Box{{0.2, 0.2, 0.2}};
  box.position = {0.0, 0.2, 0.0};
  box.velocity = {1.0, 0.0, 0.0};
  box.mass = 1.0;
  def.bodies = {slab("floor", -3.0, 0.5), kerb, box};
  World world(def);
  world.advance(def.duration);
  CHECK(world.sample(def.duration).bodies.back().x.x() < 0.31);
}
