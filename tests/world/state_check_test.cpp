// Positions, velocities, accelerations: what is wrong with a state, and the stages that find it,
// each alone (the three "Problem" slides of the lecture, SH2, SD24).
#include "sim/state_check.h"

#include "sim/body/force.h"
#include "sim/body/mass_properties.h"
#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

WorldDef twoBoxes() {
  WorldDef def;
  def.method = "course";
  def.bodies = {ground(0.0, 0.5), box("lower", {1.0, 0.5, 1.0}, {0.0, 0.25, 0.0}, 0.0, 0.5),
                box("upper", {0.5, 0.5, 0.5}, {0.1, 0.75, 0.0}, 0.0, 0.5)};
  return def;
}

std::vector<StateLayer> layers(const StartCheck& check) {
  std::vector<StateLayer> list;
  for (const StateFault& fault : check.faults) list.push_back(fault.layer);
  return list;
}

}  // namespace

// Oracle: closed form. Two boxes that rest would fall at g; the forces that hold them carry 125 kg
// and 625 kg.
TEST_CASE("a state at rest is legal in all three layers, thanks to contact forces") {
  const StartCheck check = World::checkStart(twoBoxes());
  CHECK(check.faults.empty());
  CHECK(check.resting == 8);
  CHECK(check.unheld == Approx(-9.81).epsilon(1e-12));
  double onFloor = 0.0, onLower = 0.0;
  for (const ContactSample& c : check.sample.contacts)
    (c.b == 0 ? onFloor : onLower) += c.force.y();
  CHECK(onLower == Approx(125.0 * 9.81).epsilon(1e-9));
  CHECK(onFloor == Approx(625.0 * 9.81).epsilon(1e-9));
}

// Oracle: the fault that was put in, with its size.
TEST_CASE("positions that are not ok are named with pair and depth") {
  WorldDef def = twoBoxes();
  def.bodies[2].position.y() = 0.75 - 0.03;
  const StartCheck check = World::checkStart(def);
  REQUIRE(layers(check) == std::vector<StateLayer>{StateLayer::Positions});
  CHECK(check.faults[0].a == 2);
  CHECK(check.faults[0].b == 1);
  CHECK(check.faults[0].amount == Approx(-0.03).epsilon(1e-12));
  CHECK(check.faults[0].n.y() == Approx(1.0));
  // The world itself refuses such a start; the check is for looking at it.
  CHECK_THROWS_AS(World(def), Refusal);
}

TEST_CASE("velocities that are not ok are named with pair and approach") {
  WorldDef def = twoBoxes();
  def.bodies[2].velocity = {0.2, -0.4, 0.0};
  const StartCheck check = World::checkStart(def);
  REQUIRE(layers(check) == std::vector<StateLayer>{StateLayer::Velocities});
  CHECK(check.faults[0].a == 2);
  CHECK(check.faults[0].b == 1);
  CHECK(check.faults[0].amount == Approx(-0.4).epsilon(1e-12));

  // Separating contacts are fine, and so is sliding along.
  def.bodies[2].velocity = {0.2, 0.4, 0.0};
  CHECK(World::checkStart(def).faults.empty());
  def.bodies[2].velocity = {0.2, 0.0, 0.0};
  CHECK(World::checkStart(def).faults.empty());
}

// Oracle: closed form. Springs give no force at no depth, so what rests on them falls at g.
TEST_CASE("accelerations that are not ok are named with pair and size") {
  WorldDef def = twoBoxes();
  for (BodyDef& body : def.bodies) body.friction = 0.0;
  def.course.contact = "penalty";
  def.bodies.pop_back();
  const StartCheck check = World::checkStart(def);
  REQUIRE(layers(check) == std::vector<StateLayer>{StateLayer::Accelerations});
  CHECK(check.faults[0].a == 1);
  CHECK(check.faults[0].b == 0);
  CHECK(check.faults[0].amount == Approx(-9.81).epsilon(1e-12));
}

// Oracle: closed form. Contact forces that are too small by a fifth leave a fifth of g, those that
// hold leave nothing: measured 2e-15 m/s², allowed 1e-12.
TEST_CASE("forces hold accelerations at zero or are found out") {
  Model model;
  model.def.bodies = {ground(), ball("ball", 0.2, {0.0, 0.2, 0.0})};
  model.shapes = {HalfSpace{}, Sphere{0.2}};
  model.solid = {0, 1};
  RigidBody still = makeBody(solidMass(Sphere{0.2}, 1.0));
  still.x = {0.0, 0.2, 0.0};
  updateDerived(still);
  const std::vector<RigidBody> bodies = {makeFixedBody({}), still};

  // Stage one: what touches. Stage two: overlaps and approaches. Stage three: forces.
  std::vector<Contact> contacts = touchingContacts(model, bodies);
  REQUIRE(contacts.size() == 1);
  CHECK(overlapping(model, contacts).empty());
  CHECK(approaching(model, bodies, contacts).empty());
  std::vector<RigidBody> pulled = bodies;
  sumForces(model.def.gravity, {}, pulled);
  REQUIRE(sinking(model, pulled, contacts).size() == 1);
  CHECK(sinking(model, pulled, contacts)[0].amount == Approx(-9.81).epsilon(1e-14));

  std::vector<RigidBody> held = pulled;
  addContactForces(model, held, contacts);
  CHECK(sinking(model, held, contacts).empty());
  CHECK(std::abs(normalAcceleration(held[1], held[0], contacts[0].point)) < 1e-12);
  CHECK(contacts[0].force.y() == Approx(9.81).epsilon(1e-14));

  std::vector<RigidBody> weak = pulled;
  applyForce(weak[1], contacts[0].point.p, 0.8 * contacts[0].force);
  REQUIRE(sinking(model, weak, contacts).size() == 1);
  CHECK(sinking(model, weak, contacts)[0].amount == Approx(-0.2 * 9.81).epsilon(1e-12));
}

// Oracle: linear algebra. On a slope the part of the weight along n is held, F − (n·F) n is left.
TEST_CASE("a resting contact cancels the part of a force along n and no other") {
  const double angle = 0.4;
  WorldDef def;
  def.method = "course";
  def.gravity = {9.81 * std::sin(angle), -9.81 * std::cos(angle), 0.0};
  def.bodies = {ground(), ball("ball", 0.2, {0.0, 0.2, 0.0})};
  const StartCheck check = World::checkStart(def);
  CHECK(check.faults.empty());
  REQUIRE(check.sample.contacts.size() == 1);
  const Vec3 force = check.sample.contacts[0].force;
  CHECK(force.y() == Approx(9.81 * std::cos(angle)).epsilon(1e-14));
  CHECK(std::abs(force.x()) < 1e-14);
}
