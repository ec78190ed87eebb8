// Chapter 11: a scene far from the origin moves as one that stands there, to the last bit.
#include "sim/origin.h"

#include <cmath>
#include <string>

#include "tests/catch.h"
#include "tests/world/bent_bodies.h"
#include "tests/world/falling_ells.h"
#include "tests/world/joints.h"
#include "tests/world/scenes.h"

using namespace tumble;
using scenes::ball;
using scenes::box;
using scenes::ground;
using scenes::worldOf;

namespace {

constexpr double kFar = 1048576.0;            // [m] 2^20: places there are multiples of 2^-32 m
constexpr double kEpsilon = 1.0 / (1 << 30);  // [m] what places of these tests are multiples of
const Vec3 kShift(kFar, -kFar, 2.0 * kFar);

Vec3 coarse(const Vec3& p) {
  return kEpsilon * (p / kEpsilon).array().round().matrix();
}

/// The same with places that the far scene has without rounding.
WorldDef coarse(WorldDef def) {
  for (BodyDef& body : def.bodies) body.position = coarse(body.position);
  return def;
}

/// Boxes and balls that hit, roll and slide.
WorldDef dropped(const char* method) {
  WorldDef def = worldOf(method, 1.0, {ground(0.5, 0.4)});
  def.bodies.push_back(box("box", {0.3, 0.2, 0.1}, {-0.5, 0.4, 0.0}, 0.3, 0.4));
  def.bodies.back().velocity = {1.0, 0.0, 0.5};
  def.bodies.back().angularVelocity = {1.0, 2.0, 3.0};
  def.bodies.push_back(ball("ball", 0.125, {0.5, 0.5, 0.0}, 0.6, 0.4));
  def.bodies.back().velocity = {-1.0, 0.0, 0.0};
  return def;
}

/// What the world holds: by a hinge, by a spring, by a field.
WorldDef held(const char* method) {
  WorldDef def = worldOf(method, 1.0, {});
  def.bodies.push_back(scenes::bar("bar", 0.5, 1.0, {0.0, 1.0, 0.0}, 1.0));
  def.joints = {scenes::hinge(0, kNoBody, {0.0, 1.0, 0.0})};
  def.bodies.push_back(box("weight", {0.2, 0.2, 0.2}, {1.0, 0.5, 0.0}));
  def.forces.push_back(Spring{.a = 1,
                              .anchorA_B = {0.0625, 0.0625, 0.0},
                              .anchorB_B = {1.0, 2.0, 0.25},
                              .stiffness = 300.0,
                              .damping = 0.5,
                              .rest = 1.0});
  def.bodies.push_back(ball("planet", 0.0625, {-1.0, 0.0, 0.0}));
  def.bodies.back().velocity = {0.0, 1.0, 0.0};
  def.forces.push_back(CircularField{.body = 2, .centre = {-1.5, 0.0, 0.0}});
  return def;
}

/// Boxes on a plane that turns about a point of its own.
WorldDef carried(const char* method) {
  WorldDef def = worldOf(method, 1.0, {ground(0.0, 0.5)});
  def.bodies[0].position = {-0.125, 0.0, 0.0};
  def.bodies[0].angularVelocity = {0.0, 1.5, 0.0};
  for (const double side : {-1.0, 1.0}) {
    def.bodies.push_back(box("rider", {0.2, 0.2, 0.2}, {-0.125 + 0.5 * side, 0.1, 0.0}, 0.0, 0.5));
    def.bodies.back().velocity = {0.0, 0.0, -0.75 * side};
    def.bodies.back().angularVelocity = {0.0, 1.5, 0.0};
  }
  return def;
}

void requireSame(const Sample& near, const Sample& far) {
  REQUIRE(near.bodies.size() == far.bodies.size());
  for (std::size_t i = 0; i < near.bodies.size(); ++i) {
    const BodySample &a = near.bodies[i], &b = far.bodies[i];
    CAPTURE(near.t, i);
    REQUIRE(b.x == a.x + kShift);
    REQUIRE(b.q.coeffs() == a.q.coeffs());
    REQUIRE(b.v == a.v);
    REQUIRE(b.omega == a.omega);
  }
  REQUIRE(near.contacts.size() == far.contacts.size());
  for (std::size_t i = 0; i < near.contacts.size(); ++i) {
    REQUIRE(far.contacts[i].p == near.contacts[i].p + kShift);
    REQUIRE(far.contacts[i].force == near.contacts[i].force);
  }
  REQUIRE(near.joints.size() == far.joints.size());
  for (std::size_t i = 0; i < near.joints.size(); ++i) {
    REQUIRE(far.joints[i].p == near.joints[i].p + kShift);
    REQUIRE(far.joints[i].force == near.joints[i].force);
  }
}

Vec3 weightOf(const World& world) {
  double mass = 0.0;
  for (const BodyDef& body : world.model().def.bodies)
    if (!body.fixed) mass += bodyMass(body);
  return mass * world.model().def.gravity;
}

/// Runs both to the end. Oracle: the scene at the origin.
void requireSame(const WorldDef& near) {
  World here(near), there(shifted(near, kShift));
  CAPTURE(near.method, there.origin());
  REQUIRE(here.origin() == Vec3::Zero());
  const Report &report = here.report(), &told = there.report();
  for (int k = 0; k <= 10; ++k) {
    const double t = 0.1 * k * near.duration;
    here.advance(t);
    there.advance(t);
    requireSame(here.sample(t), there.sample(t));
    const double apart = there.sample(t).potential - here.sample(t).potential;
    REQUIRE(apart == Approx(-weightOf(here).dot(kShift)).epsilon(1e-14));  // measured 0
  }
  REQUIRE(told.events.size() == report.events.size());
  for (std::size_t i = 0; i < told.events.size(); ++i) {
    REQUIRE(told.events[i].t == report.events[i].t);
    REQUIRE(told.events[i].p == report.events[i].p + kShift);
  }
  const double gained = told.certificate.energy_start - report.certificate.energy_start;
  CHECK(gained == Approx(-weightOf(here).dot(kShift)).epsilon(1e-14));  // measured 0
  CHECK(told.certificate.max_penetration == report.certificate.max_penetration);
  CHECK(told.certificate.energy_balance_error == report.certificate.energy_balance_error);
}

}  // namespace

TEST_CASE("a world a thousand kilometres away moves as one at the origin, to the bit") {
  for (const char* method : {"exact", "stepping", "course"}) requireSame(coarse(dropped(method)));
  for (const char* method : {"stepping", "course"}) requireSame(coarse(held(method)));
  for (const char* method : {"exact", "stepping"}) requireSame(coarse(carried(method)));
  WorldDef cloth = clothOnBall(5, 1.0, 100.0, 0.25, 0.3);
  cloth.method = "stepping";
  cloth.duration = 0.5;
  requireSame(coarse(cloth));
}

TEST_CASE("a far world saves, goes back and goes on in the places of its scene") {
  const WorldDef near = coarse(dropped("stepping"));
  World here(near), there(shifted(near, kShift));
  here.advance(0.5);
  there.advance(0.5);
  const SavedWorld saved = there.save();
  const Sample middle = there.sample(0.5);
  there.advance(1.0);
  const std::size_t events = there.report().events.size();
  there.restore(saved);
  CHECK(there.report().events.size() == here.report().events.size());
  there.advance(1.0);
  here.advance(1.0);
  CHECK(there.report().events.size() == events);
  requireSame(here.sample(1.0), there.sample(1.0));

  World on(near, here.sample(1.0)), onThere(shifted(near, kShift), middle);
  CHECK(onThere.sample(0.0).bodies[1].x == middle.bodies[1].x);
  requireSame(on.sample(0.0), World(shifted(near, kShift), there.sample(1.0)).sample(0.0));
}

TEST_CASE("what a scene is counted from is zero unless it stands far away") {
  CHECK(originOf(dropped("exact")) == Vec3::Zero());
  CHECK(originOf(held("course")) == Vec3::Zero());
  CHECK(originOf(scenes::stackOf(5, 5, 5, true, 0.0)) == Vec3::Zero());
  // One ball flies alone: nothing is rounded but its place.
  CHECK(originOf(worldOf("exact", 1.0, {ball("ball", 0.1, {1e6, 1e6, 0.0})})) == Vec3::Zero());
  WorldDef broken = dropped("exact");
  broken.bodies[1].position.x() = std::nan("");
  CHECK(originOf(broken) == Vec3::Zero());
  // On the ground, whatever its height.
  const Vec3 origin = originOf(shifted(dropped("exact"), {1000.3, 7.7, 0.0}));
  CHECK(origin.y() == 7.7);
  CHECK(origin.x() == Approx(1000.3).margin(2.0));
}

// Its place is what a plane turns about, and nothing else.
TEST_CASE("a plane at rest is where its equation has it") {
  for (const char* method : {"exact", "stepping", "course"}) {
    CAPTURE(method);
    WorldDef def = dropped(method);
    BodyDef ell = box("ell", {1.0, 1.0, 1.0}, {0.0, 0.105, 1.0}, 0.3, 0.4);
    ell.shape = ellOfBoxes();
    ell.shape = centredShape(ell);
    ell.orientation = fromAxisAngle({1.0, 0.0, 0.0}, 0.5 * scenes::kPi);
    ell.velocity = {0.5, 0.0, 0.25};
    ell.angularVelocity = {0.0, 1.0, 0.0};
    def.bodies.push_back(ell);
    WorldDef moved = def;
    moved.bodies[0].position = {2.0, -3.0, 1.0};
    World world(def), other(moved);
    world.advance(1.0);
    other.advance(1.0);
    const Sample a = world.sample(1.0), b = other.sample(1.0);
    for (int i = 1; i < 4; ++i) CHECK((a.bodies[i].x - b.bodies[i].x).norm() < 1e-12);
  }
}
