// Bodies that slide or roll from one body onto another that is flush with it.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "sim/math/rotation.h"
#include "sim/shape/convex_hull.h"
#include "sim/world.h"
#include "tests/catch.h"
#include "tests/world/falling_ells.h"

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

/// A slab of parts that are flush: cut at these x, and across at these z; its top is y = 0.
BodyDef cutSlab(std::vector<double> x, std::vector<double> z) {
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
  def.position = originOf(centredShape(def));
  def.fixed = true;
  return def;
}

/// How a body goes over a slab: by which method and step [s], and whether the slab glides itself.
struct Glide {
  const char* method;
  double step = 1.0 / 240.0;
  bool moving = false;
};

/// Where a body ends that starts on a slab, both turned, and gravity with them.
Vec3 endOnSlab(const Glide& glide, const BodyDef& slab, const BodyDef& body, const Quat& turn) {
  WorldDef def;
  def.method = glide.method;
  def.stepping.step = def.course.step = glide.step;
  def.duration = 2.0;
  def.gravity = turn * Vec3(0.0, -9.81, 0.0);
  def.bodies = {slab, body};
  for (BodyDef& b : def.bodies) {
    b.position = turn * b.position;
    b.velocity = turn * b.velocity;
    b.orientation = turn * b.orientation;
  }
  if (glide.moving) {
    def.bodies[0].fixed = false;
    def.bodies[0].mass = 50.0;
    def.bodies[0].velocity = turn * Vec3(0.5, 0.0, 0.0);
    BodyDef ground;
    ground.name = "ground";
    ground.shape = HalfSpace{turn * Vec3::UnitY(), -0.5};
    ground.fixed = true;
    def.bodies.insert(def.bodies.begin(), ground);
  }
  World world(def);
  world.advance(def.duration);
  return turn.conjugate() * world.sample(def.duration).bodies.back().x;
}

/// Two flush boxes that make one of these half edges.
Compound twoHalves(const Vec3& half) {
  const Box box{{0.5 * half.x(), half.y(), half.z()}};
  return {{{box, {{-0.5 * half.x(), 0.0, 0.0}}}, {box, {{0.5 * half.x(), 0.0, 0.0}}}}};
}

/// A solid that stands on seven corners.
Hull gem() {
  std::vector<Vec3> points;
  for (int k = 0; k < 7; ++k) {
    double s = 0.0, c = 0.0;
    sinCos(2.0 * std::numbers::pi * k / 7, s, c);
    points.emplace_back(0.2 * c, -0.1, 0.2 * s);
    points.emplace_back(0.1 * c, 0.1, 0.1 * s);
  }
  return {std::make_shared<const Polyhedron>(convexHull(points)), -points[0]};
}

struct Slider {
  const char* name;
  Shape shape, whole;  // in parts, and as one
  double height;       // of its origin [m]
};
std::vector<Slider> sliders() {
  const Box box{{0.2, 0.1, 0.15}};
  return {{"a box", box, box, 0.1},
          {"a box of two halves", twoHalves(box.half), box, 0.1},
          {"a ball", Sphere{0.2}, Sphere{0.2}, 0.2},
          {"a standing cylinder", Cylinder{0.2, 0.2}, Cylinder{0.2, 0.2}, 0.1},
          {"a narrow cylinder", Cylinder{0.1, 0.2}, Cylinder{0.1, 0.2}, 0.1},
          {"a flat cylinder", Cylinder{0.1, 0.05}, Cylinder{0.1, 0.05}, 0.025},
          {"a hull", gem(), gem(), 0.1}};
}

}  // namespace

namespace {

struct Matrix {
  std::vector<double> degrees;  // of the body on the slab; < 0: mirrored, and all of it aslant
  std::vector<Slider> sliders;
  std::vector<BodyDef> slabs;
};

// Farthest [m] that any of them ends from where it ends on one box.
double worstSeam(const Glide& glide, const Matrix& matrix) {
  BodyDef whole;
  whole.name = "slab";
  whole.shape = Box{{3.0, 0.25, 1.0}};
  whole.position = {0.0, -0.25, 0.0};
  whole.fixed = true;
  double off = 0.0;
  for (const double degrees : matrix.degrees) {
    const Quat about(Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vec3::UnitY()));
    const Quat aslant(Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, 3.0).normalized()));
    const Quat turn = degrees < 0.0 ? aslant : about;
    for (const Slider& slider : matrix.sliders) {
      BodyDef body;
      body.name = "body";
      body.mass = 2.0;
      body.shape = slider.whole;
      body.position = {-0.7, slider.height, 0.0};
      body.velocity = {1.5, 0.0, degrees < 0.0 ? -0.1 : 0.1};
      body.orientation = about;
      const Vec3 onOne = endOnSlab(glide, whole, body, turn);
      CAPTURE(glide.method, glide.step, glide.moving, degrees, slider.name);
      CHECK(onOne.x() == Approx(2.3).margin(1e-9));
      body.shape = slider.shape;
      for (const BodyDef& slab : matrix.slabs) {
        const double here = (endOnSlab(glide, slab, body, turn) - onOne).norm();
        CHECK(here < 1e-9);
        off = std::max(off, here);
      }
    }
  }
  return off;
}

BodyDef inOtherOrder(BodyDef slab) {
  std::vector<Part>& parts = std::get<Compound>(slab.shape).parts;
  std::reverse(parts.begin(), parts.end());
  return slab;
}
BodyDef threeSeams() {
  return cutSlab({-0.2, 0.3, 0.5}, {});
}
BodyDef manySeams() {
  return cutSlab({-0.31, 0.02, 0.17, 0.9}, {0.03});
}

}  // namespace

// Oracle: symmetry; the parts of a body that are flush are one solid, in whatever order, at any
// angle to the world and to each other, and in the mirror, whether the slab glides or not. Measured
// by `stepping` 3e-13 m, by `exact` 3e-14 m, by `course` 2e-14 m; allowed 1e-9 m, the width of a
// touch.
TEST_CASE("what slides over parts of one body that are flush goes as over one part", "[figures]") {
  const char* method = GENERATE("stepping", "exact", "course");
  const std::vector<Slider> all = sliders();
  double off = worstSeam({method}, {{-20.0}, {all[1], all.back()}, {manySeams()}});
  // Rims that hardly pass a cut at the end of a step.
  off = std::max(off, worstSeam({method}, {{10.0, 45.0}, {all[3]}, {threeSeams()}}));
  off = std::max(off, worstSeam({method}, {{60.0}, {all[4]}, {threeSeams()}}));
  WARN("seams of one body, " << method << ": measured off by " << off << " m");
}
TEST_CASE("seams of one body at all angles, of all solids, in any order of the parts",
          "[long][figures]") {
  const auto [method, step] =
      GENERATE(table<const char*, double>({{"stepping", 1.0 / 240.0},
                                           {"stepping", 1e-3},
                                           {"course", 1.0 / 240.0},
                                           {"course", 1e-3},
                                           {"exact", 1.0}}));  // has no step
  Glide glide{method, step};
  glide.moving = GENERATE(false, true);
  const double off = worstSeam(
      glide, {glide.moving ? std::vector<double>{20.0, -45.0}
                           : std::vector<double>{0.0, 10.0, 20.0, 30.0, 45.0, 60.0, -20.0, -45.0},
              sliders(),
              {cutSlab({0.0}, {}), cutSlab({-0.2, 0.5}, {}), threeSeams(),
               inOtherOrder(threeSeams()), manySeams(), inOtherOrder(manySeams())}});
  WARN("seams of one body, all solids, " << glide.method << ", a step of " << glide.step << " s, "
                                         << (glide.moving ? "gliding" : "fixed")
                                         << ": measured off by " << off << " m");
}

// Oracle: the same with one part. The slab glides on ice itself, and the box over it.
TEST_CASE("a seam of a body that moves is none either") {
  const char* method = GENERATE("stepping", "exact", "course");
  const auto ends = [&](const Shape& slab, const Shape& box) {
    WorldDef def;
    def.method = method;
    def.duration = 1.0;
    BodyDef ground, below, above;
    ground.name = "ground";
    ground.shape = HalfSpace{};
    ground.fixed = true;
    below.name = "below";
    below.shape = slab;
    below.mass = 50.0;
    below.position = {0.0, 0.25, 0.0};
    below.velocity = {-0.5, 0.0, 0.0};
    above.name = "above";
    above.shape = box;
    above.mass = 2.0;
    above.position = {-0.7, 0.6, 0.0};
    above.velocity = {1.0, 0.0, 0.1};
    above.orientation = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitY()));
    def.bodies = {ground, below, above};
    World world(def);
    world.advance(def.duration);
    const Sample end = world.sample(def.duration);
    return std::pair(end.bodies[1].x, end.bodies[2].x);
  };
  const Vec3 half(3.0, 0.25, 1.0), small(0.2, 0.1, 0.15);
  const auto one = ends(Box{half}, Box{small}), two = ends(twoHalves(half), twoHalves(small));
  CHECK(one.second.x() == Approx(0.3).margin(1e-9));
  CHECK((one.first - two.first).norm() < 1e-9);
  CHECK((one.second - two.second).norm() < 1e-9);
}

namespace {

void dropLs(int count, int columns, int worlds) {
  double deepest = 0.0, unseen = 0.0;
  for (int seed = 1; seed <= worlds; ++seed) {
    const WorldDef def =
        fallingInColumns(ellOfBoxes(), count, columns, static_cast<std::uint64_t>(seed));
    World world(def);
    world.advance(def.duration);
    const Certificate& books = world.report().certificate;
    CAPTURE(seed, books.max_penetration, books.audit_max_penetration);
    CHECK(books.max_penetration < 1e-6);
    CHECK(books.audit_max_penetration < books.max_penetration + 1e-9);
    deepest = std::max(deepest, books.max_penetration);
    unseen = std::max(unseen, books.audit_max_penetration - books.max_penetration);
  }
  WARN(worlds << " times " << count << " Ls dropped: measured overlaps to " << deepest
              << " m, unseen by the certificate " << unseen << " m");
}

}  // namespace

// Oracle: the audit, which proves overlaps part by part and knows nothing of seams. Measured 6e-10
// m by either, allowed 1e-6 m; not seen 4e-15 m, allowed 1e-9 m.
TEST_CASE("Ls that fall on each other overlap no more than their certificate says") {
  dropLs(12, 1, 8);
}
TEST_CASE("200 Ls that fall on each other overlap no more than their certificate says",
          "[long][figures]") {
  dropLs(200, 5, 1);
}
