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

namespace {

/// A slab of parts that are flush: cut at these x, and across at these z.
BodyDef cutSlab(std::vector<double> x, std::vector<double> z, double turned) {
  Compound slab;
  x.insert(x.begin(), -3.0);
  x.push_back(3.0);
  z.insert(z.begin(), -1.0);
  z.push_back(1.0);
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (std::size_t k = 0; k + 1 < z.size(); ++k) {
      // Every other row is cut once more, so that edges end inside edges of others.
      const double middle = 0.5 * (x[i] + x[i + 1]) + 0.013;
      const std::vector<double> ends = k % 2 == 0 ? std::vector<double>{x[i], x[i + 1]}
                                                  : std::vector<double>{x[i], middle, x[i + 1]};
      for (std::size_t m = 0; m + 1 < ends.size(); ++m)
        slab.parts.push_back({Box{{0.5 * (ends[m + 1] - ends[m]), 0.25, 0.5 * (z[k + 1] - z[k])}},
                              {{0.5 * (ends[m] + ends[m + 1]), -0.25, 0.5 * (z[k] + z[k + 1])}}});
    }
  BodyDef def;
  def.name = "slab";
  def.shape = slab;
  def.position = centredShape(def).index() == def.shape.index() ? originOf(centredShape(def))
                                                                : Vec3(Vec3::Zero());
  const Quat turn(Eigen::AngleAxisd(turned, Vec3::UnitY()));
  def.position = turn * def.position;
  def.orientation = turn;
  def.fixed = true;
  return def;
}

Vec3 endOnSlab(const char* method, BodyDef slab, const BodyDef& body, double turned) {
  WorldDef def;
  def.method = method;
  def.duration = 1.0;
  def.bodies = {slab, body};
  const Quat turn(Eigen::AngleAxisd(turned, Vec3::UnitY()));
  def.bodies[1].position = turn * body.position;
  def.bodies[1].velocity = turn * body.velocity;
  def.bodies[1].orientation = turn * body.orientation;
  World world(def);
  world.advance(def.duration);
  return turn.conjugate() * world.sample(def.duration).bodies.back().x;
}

/// Two flush boxes that make one of these half edges.
Compound twoHalves(const Vec3& half) {
  const Box box{{0.5 * half.x(), half.y(), half.z()}};
  return {{{box, {{-0.5 * half.x(), 0.0, 0.0}}}, {box, {{0.5 * half.x(), 0.0, 0.0}}}}};
}

}  // namespace

// Oracle: symmetry; the parts of a body that are flush are one solid.
TEST_CASE("what slides over parts of one body that are flush goes as over one part") {
  const char* method = GENERATE("stepping", "exact", "course");
  const double turned = GENERATE(0.0, 20.0, 45.0) * std::numbers::pi / 180.0;
  BodyDef body;
  body.name = "body";
  body.mass = 2.0;
  body.velocity = {1.5, 0.0, 0.1};
  body.orientation = Quat(Eigen::AngleAxisd(turned, Vec3::UnitY()));
  SECTION("a box") {
    body.shape = Box{{0.2, 0.1, 0.15}};
    body.position = {-0.7, 0.1, 0.0};
  }
  SECTION("a box of two halves") {
    body.shape = twoHalves({0.2, 0.1, 0.15});
    body.position = {-0.7, 0.1, 0.0};
  }
  SECTION("a ball") {
    body.shape = Sphere{0.2};
    body.position = {-0.7, 0.2, 0.0};
  }
  SECTION("a standing cylinder") {
    body.shape = Cylinder{0.2, 0.2};
    body.position = {-0.7, 0.1, 0.0};
  }
  BodyDef whole;
  whole.name = "slab";
  whole.shape = Box{{3.0, 0.25, 1.0}};
  whole.position = {0.0, -0.25, 0.0};
  whole.orientation = Quat(Eigen::AngleAxisd(turned, Vec3::UnitY()));
  whole.fixed = true;
  BodyDef one = body;
  if (std::holds_alternative<Compound>(one.shape)) one.shape = Box{{0.2, 0.1, 0.15}};
  const Vec3 onOne = endOnSlab(method, whole, one, turned);
  CAPTURE(method, turned, shapeName(body.shape));
  CHECK(onOne.x() > 0.3);
  CHECK((endOnSlab(method, cutSlab({0.0}, {}, turned), body, turned) - onOne).norm() < 1e-9);
  CHECK((endOnSlab(method, cutSlab({-0.31, 0.02, 0.17}, {0.03}, turned), body, turned) - onOne)
            .norm() < 1e-9);
}
