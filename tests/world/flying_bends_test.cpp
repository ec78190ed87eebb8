// What bends in free flight, alone and with what it touches there, until it lands.
#include <algorithm>
#include <cmath>

#include "sim/elastic/strand.h"
#include "sim/world.h"
#include "tests/catch.h"
#include "tests/world/bent_bodies.h"

using namespace tumble;

namespace {

const Vec3 kGravity(0.7, -9.81, -1.3);  // [m/s²] along no axis

SoftDef jello(SoftLaw law) {
  return {.cells = {2, 3, 2},
          .size = {0.2, 0.3, 0.2},
          .density = 1000.0,
          .law = law,
          .solid = solidityOf(1.5e4, law == SoftLaw::Matching ? 0.0 : 0.25, 20.0)};
}

/// Adds something that bends to a world. @return the number of its first point
int addBent(WorldDef& def, const std::string& name, const Vec3& middle) {
  if (name == "cloth")
    return addCloth(
        def, {.columns = 7, .rows = 6, .length = 0.5, .width = 0.4, .bend = 2e-5, .damping = 0.02},
        middle, 0.005, 0.4);
  if (name == "strand") {
    const StrandDef strand{
        .points = 8, .length = 0.3, .density = 0.01, .stretch = 5.0, .bend = 1e-4};
    const int first =
        addPoints(def, "hair", strandPlaces(strand), strandMasses(strand), middle, 0.002, 0.4);
    return bend(def, "hair", first, strandElements(strand, first));
  }
  return addSoft(def,
                 jello(name == "lattice"    ? SoftLaw::Lattice
                       : name == "matching" ? SoftLaw::Matching
                       : name == "rubber"   ? SoftLaw::NeoHookean
                                            : SoftLaw::Corotated),
                 middle, 0.005, 0.4);
}

/// Sum of the masses of bodies from the first on, and their momentum and centre by them.
struct Whole {
  double mass = 0.0;
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();
};
Whole wholeOf(const WorldDef& def, const Sample& sample, int first = 0) {
  Whole whole;
  for (std::size_t i = first; i < def.bodies.size(); ++i) {
    const double M = *def.bodies[i].mass;
    whole.mass += M;
    whole.x += M * sample.bodies[i].x;
    whole.v += M * sample.bodies[i].v;
  }
  whole.x /= whole.mass;
  whole.v /= whole.mass;
  return whole;
}

/// How far [m], and [m/s], the centre of bodies from the first on misses its parabola, at most.
double missesParabola(const WorldDef& def, World& world, const Vec3& a, int first = 0) {
  const Whole start = wholeOf(def, world.sample(0.0), first);
  const int steps = static_cast<int>(std::lround(def.duration / def.stepping.step));
  double off = 0.0;
  for (int k = 1; k <= steps; ++k) {
    world.advance(k * def.stepping.step);
    for (const double t : {(k - 0.3) * def.stepping.step, k * def.stepping.step}) {
      const Whole now = wholeOf(def, world.sample(t), first);
      off = std::max({off, (now.x - start.x - t * start.v - 0.5 * t * t * a).norm(),
                      (now.v - start.v - t * a).norm()});
    }
  }
  return off;
}

}  // namespace

// Oracle: closed form. The centre of mass of what is free falls on a parabola, whatever goes on
// inside: here it is stretched, and turns. The same wind on each of n points pushes it with n of
// them. Measured 2e-13 m, and 0.02 m where points move by their velocities at the end of a step.
TEST_CASE("what bends falls on a parabola, at any instant") {
  const char* name = GENERATE("cloth", "strand", "corotated", "rubber", "lattice", "matching");
  const bool wind = GENERATE(false, true);
  WorldDef def;
  def.gravity = kGravity;
  def.duration = 0.5;
  def.stepping.step = 1.0 / 120.0;
  const Vec3 middle(0.3, 1.0, -0.2);
  addBent(def, name, middle);
  double mass = 0.0;
  for (BodyDef& body : def.bodies) {
    const Vec3 arm = body.position - middle;
    body.velocity = Vec3(1.0, 2.0, -0.5) + Vec3(1.0, -2.0, 0.5).cross(arm) + 0.8 * arm;
    mass += *body.mass;
  }
  const Vec3 force = wind ? Vec3(2e-3, 0.0, 1e-3) : Vec3::Zero();
  if (wind) def.forces.push_back(UniformWind{.force = force});
  World world(def);
  const double off =
      missesParabola(def, world, kGravity + static_cast<double>(def.bodies.size()) / mass * force);
  REQUIRE_FALSE(world.report().stopped);
  const Certificate& c = world.report().certificate;
  CAPTURE(name, wind, off, c.energy_balance_error, c.momentum_error, c.audit_energy_error);
  CHECK(off <= 1e-12);
  CHECK(c.momentum_error <= 1e-12);
  CHECK(c.energy_balance_error <= 1e-12);
  CHECK(world.report().disagreements.empty());
}

// Oracle: closed form, and invariants. What flies may touch what flies with it: a ball that is
// thrown into it, or hangs on a corner. Measured 4e-13 m; nothing sinks in.
TEST_CASE("what bends and solids that it meets in flight fall on a parabola together") {
  const char* name = GENERATE("cloth", "corotated");
  const bool hangs = GENERATE(false, true);
  WorldDef def;
  def.gravity = kGravity;
  def.duration = 0.4;
  def.stepping.step = 1.0 / 120.0;
  const double above = std::string(name) == "cloth" ? 0.09 : 0.23;
  def.bodies.push_back({.name = "ball",
                        .shape = Sphere{0.06},
                        .mass = 0.3,
                        .friction = 0.4,
                        .position = {0.02, above, 0.01},
                        .velocity = {0.2, hangs ? 3.0 : -1.0, 0.0},
                        .angularVelocity = {3.0, 0.0, 5.0}});
  const int first = addBent(def, name, Vec3::Zero());
  if (hangs) {
    const Vec3 corner = def.bodies[first].position;
    def.bodies[0].position = corner - Vec3(0.1, 0.0, 0.0);
    def.bodies[0].velocity = def.bodies[0].angularVelocity.setZero();
    def.joints.push_back({.name = "pin",
                          .kind = JointKind::Ball,
                          .a = first,
                          .b = 0,
                          .anchorA = corner,
                          .anchorB = corner});
  }
  World world(def);
  const double off = missesParabola(def, world, kGravity);
  REQUIRE_FALSE(world.report().stopped);
  const Certificate& c = world.report().certificate;
  CAPTURE(name, hangs, off, c.energy_balance_error, c.momentum_error, c.max_penetration,
          c.energy_lost_impact, c.max_joint_gap);
  CHECK(off <= 1e-12);
  CHECK(c.momentum_error <= 1e-12);
  CHECK(c.energy_balance_error <= 1e-10);
  CHECK(c.max_penetration <= 1e-9);
  CHECK(c.max_joint_gap <= 1e-9);
  CHECK((hangs || c.energy_lost_impact > 1e-4));
  CHECK(world.report().disagreements.empty());
}

namespace {

/// The step in which a body or a point first touches the floor.
int landsIn(const WorldDef& def, World& world, int first) {
  const int steps = static_cast<int>(std::lround(def.duration / def.stepping.step));
  for (int k = 1; k <= steps; ++k) {
    world.advance(k * def.stepping.step);
    for (const ContactSample& c : world.sample(k * def.stepping.step).contacts)
      if (std::max(c.a, c.b) >= first && !c.force.isZero(0.0)) return k;
  }
  return 0;
}

}  // namespace

// Oracle: closed form. The step in which something lands is the one in which its fall ends: here
// in the midst of its second quarter. Points that move by their velocities at the end of a step
// fall by ½ g h t too far and land half a step early.
TEST_CASE("what bends lands in the step in which a brick does") {
  const char* name = GENERATE("cloth", "corotated", "brick");
  const char* points = GENERATE("constraint", "implicit");
  const Vec3 up = GENERATE(Vec3(0.0, 1.0, 0.0), Vec3(0.6, 0.0, -0.8));
  WorldDef def;
  def.gravity = -9.81 * up;
  def.duration = 0.6;
  def.stepping.step = 1.0 / 100.0;
  def.stepping.points = points;
  def.bodies.push_back({.name = "floor", .shape = HalfSpace{up, 0.0}, .mass = 1.0, .fixed = true});
  const double lasts = 40.3 * def.stepping.step, height = 0.5 * 9.81 * lasts * lasts;
  if (std::string(name) == "brick")
    def.bodies.push_back({.name = "brick", .shape = Box{{0.1, 0.1, 0.1}}, .mass = 1.0});
  else
    addBent(def, name, Vec3::Zero());
  const Quat turn = Quat::FromTwoVectors(Vec3::UnitY(), up);
  double lowest = 0.0;
  for (std::size_t i = 1; i < def.bodies.size(); ++i)
    lowest = std::min(lowest, def.bodies[i].position.y());
  lowest -= std::string(name) == "brick" ? 0.1 : 0.005;
  for (std::size_t i = 1; i < def.bodies.size(); ++i) {
    def.bodies[i].position = turn * def.bodies[i].position + (height - lowest) * up;
    if (std::string(name) == "brick") def.bodies[i].orientation = turn;
  }
  World world(def);
  const int step = landsIn(def, world, 1);
  const Certificate& c = world.report().certificate;
  CAPTURE(name, points, step, c.max_penetration, c.energy_added_repair);
  CHECK(step == (std::string(points) == "implicit" && std::string(name) != "brick" ? 42 : 41));
  if (std::string(points) == "constraint") {
    CHECK(c.max_penetration <= 1e-12);
    CHECK(c.energy_added_repair == 0.0);
  }
}

// Oracle: invariants. What is thrown against a ceiling falls away from it, so that its way is
// longer than its velocity at the end of a step says: none of it gets in, and nothing has to be
// lifted out.
TEST_CASE("what bends is stopped by what is above it as by what is below") {
  const char* name = GENERATE("cloth", "corotated");
  const double v = GENERATE(1.0, 1.4, 1.5, 2.0);
  WorldDef def;
  def.duration = 0.5;
  def.stepping.step = 1.0 / 60.0;
  def.bodies.push_back(
      {.name = "ceiling", .shape = HalfSpace{-Vec3::UnitY(), 0.0}, .mass = 1.0, .fixed = true});
  addBent(def, name, {0.0, -0.26, 0.0});
  for (std::size_t i = 1; i < def.bodies.size(); ++i) def.bodies[i].velocity = {0.2, v, 0.0};
  World world(def);
  world.advance(def.duration);
  REQUIRE_FALSE(world.report().stopped);
  const Certificate& c = world.report().certificate;
  CAPTURE(name, v, c.max_penetration, c.energy_added_repair, c.energy_balance_error);
  CHECK(c.max_penetration <= 1e-12);
  CHECK(c.energy_added_repair == 0.0);
  CHECK(c.energy_balance_error <= 1e-10);
  CHECK(c.momentum_error <= 1e-10);
}
