// Bodies under springs, drag and forces off their centres, in steps: against closed forms, against
// the equation of motion, and for any stiffness.
#include <cmath>
#include <vector>

#include "sim/math/rotation.h"
#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

WorldDef steps(double duration, double h = 1.0 / 240.0) {
  WorldDef def;
  def.method = "stepping";
  def.duration = duration;
  def.stepping.step = h;
  return def;
}

/// A box of 8 kg hung by a corner on a spring of this stiffness, above a floor that it never meets.
WorldDef hungBox(double stiffness, double h = 1.0 / 240.0) {
  WorldDef def = steps(20.0, h);
  def.bodies = {ground(), box("box", {0.2, 0.2, 0.2}, {0.0, 5.0, 0.0})};
  def.bodies[1].density.reset();
  def.bodies[1].mass = 8.0;
  Spring spring{.a = 1, .stiffness = stiffness, .rest = 1.0};
  spring.anchorA_B = {0.1, 0.1, 0.1};
  spring.anchorB_B = {0.1, 6.1, 0.1};
  def.forces = {spring};
  return def;
}

WorldDef byCourse(WorldDef def) {
  def.method = "course";
  def.course.integrator = "dopri5";
  def.course.tolerance = 1e-13;
  return def;
}

/// Largest gain of kinetic and potential energy [J] over the start, at samples.
double largestGain(World& world, double duration) {
  const Sample start = world.sample(0.0);
  double gain = 0.0;
  for (int k = 1; k <= 60; ++k) {
    world.advance(duration * k / 60.0);
    const Sample s = world.sample(duration * k / 60.0);
    gain = std::max(gain, s.kinetic + s.potential - start.kinetic - start.potential);
  }
  return gain;
}

/// A box of millimetres that a spring throws about, up to radians of its swing in a step.
WorldDef pebble(double stiffness, bool floor) {
  WorldDef def = steps(0.5);
  if (floor) def.bodies = {ground()};
  def.bodies.push_back(box("pebble", {0.0053, 0.0093, 0.003}, {0.005, 0.016, -0.0036}));
  BodyDef& body = def.bodies.back();
  body.density = 800.0;
  body.friction = 0.1;
  body.orientation = Quat(0.42, 0.40, 0.15, -0.80).normalized();
  body.velocity = {0.36, 0.12, 0.17};
  body.angularVelocity = {23.0, -4.4, -9.9};
  Spring spring{
      .a = static_cast<int>(def.bodies.size()) - 1, .stiffness = stiffness, .rest = 0.017};
  spring.anchorA_B = {0.0008, 0.0015, 0.0001};
  spring.anchorB_B = {-0.031, 0.038, 0.0};
  def.forces = {spring};
  return def;
}

}  // namespace

// Oracles: energy, and the equation of motion by another program of steps. Measured 2e-11 J of some
// 30 J, and 1e-11 m after 2 s; allowed 1e-9 J, 1e-9 m.
TEST_CASE("a box hung by its corner on a spring keeps its energy and follows its motion") {
  World world(hungBox(500.0));
  CHECK(largestGain(world, 20.0) < 1e-9);
  const Certificate& books = world.report().certificate;
  CHECK(std::abs(books.energy_end - books.energy_start) < 1e-9);
  World again(hungBox(500.0)), reference(byCourse(hungBox(500.0)));
  again.advance(2.0);
  reference.advance(2.0);
  CHECK((again.sample(2.0).bodies[1].x - reference.sample(2.0).bodies[1].x).norm() < 1e-9);
}

// Oracle: energy. In flight it stays, and landings only take: without parts of a step their books
// are open by 0.95 and 0.75. Measured: gains of less than 1e-13, balance 6e-12 in flight and 0.041
// with a floor.
TEST_CASE("stepping: a pebble on a spring gains nothing, in flight or from the floor") {
  for (const double stiffness : {0.2, 2.0, 20.0, 100.0}) {
    for (const bool floor : {false, true}) {
      CAPTURE(stiffness, floor);
      World world(pebble(stiffness, floor));
      const double gain = largestGain(world, 0.5);
      const Certificate& c = world.report().certificate;
      CHECK_FALSE(world.report().stopped);
      CAPTURE(gain / c.energy_start, c.energy_balance_error);
      CHECK(gain <= 1e-9 * c.energy_start);
      CHECK(c.energy_balance_error <= (floor ? 0.1 : 1e-9));
    }
  }
}

// Invariant: stiff springs give no energy, k h²/m from 10 to 1e7. What is measured is h F·v/2,
// since velocities stand half a step off the poses, and in the last row the stretch that a step of
// h³ leaves: it swings and does not grow. Measured 0.58 J of some 30 J, allowed 1 J.
TEST_CASE("stiff springs of any strength end their run and do not pump energy") {
  for (const double stiffness : {5e6, 5e7, 5e8, 5e10}) {
    CAPTURE(stiffness);
    World world(hungBox(stiffness));
    CHECK(largestGain(world, 20.0) < 1.0);
    CHECK_FALSE(world.report().stopped);
  }
  World world(hungBox(1e16));
  world.advance(20.0);
  CHECK_FALSE(world.report().stopped);
}

// Oracle: bit-equal rerun, while what memory held before differs: all that is freed was filled with
// NaN. The spring hangs from the world, which has velocities of its own in no step.
TEST_CASE("a run does not depend on what memory held before") {
  const auto closing = [](double left) {
    for (std::size_t size = 1; size < 200; ++size) {
      std::vector<std::vector<double>> blocks(8, std::vector<double>(size, left));
      CHECK(blocks.back().back() != 1.0);
    }
    WorldDef def = hungBox(1e6);
    def.duration = 0.5;
    World world(def);
    run(world);
    return world.report().certificate;
  };
  const Certificate first = closing(0.0), second = closing(std::nan(""));
  CHECK(std::isfinite(second.energy_balance_error));
  CHECK(first.work_of_forces == second.work_of_forces);
  CHECK(first.energy_balance_error == second.energy_balance_error);
}

// Oracle: closed form, v = v₀ e^{−ct/m} + (F/c)(1 − e^{−ct/m}) and its integral. Measured 2e-16
// relative, allowed 1e-13; c h/m from 2e-3 to 4e7.
TEST_CASE("drag of any strength is the exponential") {
  for (const double c : {0.5, 50.0, 1e4, 1e10}) {
    CAPTURE(c);
    WorldDef def = steps(2.0);
    def.bodies = {ball("ball", 0.1, {0.0, 3.0, 0.0})};
    def.bodies[0].velocity = {4.0, 1.0, -2.0};
    def.forces = {LinearDrag{.linear = c}, UniformWind{.force = {3.0, 0.0, 1.0}}};
    World world(def);
    const Sample end = run(world);
    const Vec3 F = Vec3(3.0, -9.81, 1.0), v0 = def.bodies[0].velocity, limit = F / c;
    const double left = std::exp(-2.0 * c);
    const Vec3 v = limit + left * (v0 - limit);
    const Vec3 x = def.bodies[0].position + 2.0 * limit + (1.0 - left) / c * (v0 - limit);
    CHECK((end.bodies[0].v - v).norm() < 1e-13 * (1.0 + v.norm()));
    CHECK((end.bodies[0].x - x).norm() < 1e-13 * (1.0 + x.norm()));
    CHECK(world.report().certificate.energy_balance_error < 1e-12);
  }
}

// Oracle: closed form. About a principal axis the spin of a box decays by itself, and it has turned
// by I ω/c (1 − e^{−ct/I}) then, however far within a step that is. Measured 2e-16 rad; of a spin
// that stops within a step, all of the turn was missed where its half was followed.
TEST_CASE("a box that drag brakes turns as far as its spin decays, within a step too") {
  for (const double c : {0.01, 1.0, 100.0, 1e6}) {
    CAPTURE(c);
    WorldDef def = steps(0.5);
    def.bodies = {box("box", {0.2, 0.3, 0.4}, {0.0, 3.0, 0.0})};
    def.bodies[0].angularVelocity = {0.0, 0.0, 5.0};
    def.forces = {LinearDrag{.angular = c}};
    World world(def);
    const double I = 1000.0 * 0.2 * 0.3 * 0.4 * (0.2 * 0.2 + 0.3 * 0.3) / 12.0;
    const Sample end = run(world);
    const double turn = I * 5.0 / c * -std::expm1(-0.5 * c / I);
    CHECK(turnVector(end.bodies[0].q).z() == Approx(turn).epsilon(1e-12));
    CHECK(world.report().certificate.audit_spin_error < 1e-9);
    CHECK(world.report().disagreements.empty());
  }
}

// Oracle: energy. What drag brakes lands within a step, askew and flat: the way on which its weight
// works beyond what the step gave it is booked; and what comes to rest there takes from the floor
// what its weight gives. Measured 6.3e-9 and 4.9e-16; of momentum 2.5e-15.
TEST_CASE("drag and landings share no energy, and no momentum, that nothing books") {
  for (const Vec3& axis : {Vec3(0.3, 0.2, 1.0), Vec3(0.0, 1.0, 0.0)}) {
    WorldDef def = steps(0.6);
    def.bodies = {ground(0.0, 0.5), box("box", {0.2, 0.3, 0.4}, {0.0, 0.6, 0.0}, 0.0, 0.5)};
    def.bodies[1].orientation = fromAxisAngle(axis.normalized(), 0.5);
    def.bodies[1].velocity = {1.0, -1.0, 0.3};
    def.forces = {LinearDrag{.body = 1, .linear = 6.0, .angular = 0.05}};
    World world(def);
    run(world);
    const Certificate& books = world.report().certificate;
    CAPTURE(books.energy_balance_error, books.energy_lost_impact);
    CHECK(books.energy_balance_error < 1e-7);
    CHECK(books.momentum_error < 1e-12);
  }
}

// Oracle: equilibrium. Under a stiff spring a box presses with m g + k s, whatever k h²/m, and
// stays. Measured 3e-13 relative.
TEST_CASE("a spring that presses a box on the floor adds its force to the weight") {
  for (const double stiffness : {1e2, 1e6, 1e10}) {
    CAPTURE(stiffness);
    WorldDef def = steps(1.0);
    def.bodies = {ground(0.0, 0.5), box("box", {0.2, 0.2, 0.2}, {0.0, 0.1, 0.0}, 0.0, 0.5)};
    Spring spring{.a = 1, .stiffness = stiffness, .rest = 1.0 + 1e-3};
    spring.anchorA_B = {0.0, 0.1, 0.0};
    spring.anchorB_B = {0.0, 1.2, 0.0};
    def.forces = {spring};
    World world(def);
    const Sample end = run(world);
    double sum = 0.0;
    for (const ContactSample& c : end.contacts) sum += c.force.y();
    CHECK(sum == Approx(8.0 * 9.81 + stiffness * 1e-3).epsilon(1e-8));
    CHECK((end.bodies[1].x - def.bodies[1].position).norm() < 1e-9);
  }
}

// Oracle: halved steps, and the equation of motion by another program. A force that grips a box off
// its centre slides and turns it on the floor: place, and the work that the audit finds along its
// way, err by h². Measured 4.0 each time, 9.3e-7 of the energy and 2.4e-7 m at 1/240 s; allowed
// 3.5 to 4.5, and 2e-6.
TEST_CASE("a box that is pushed off its centre on the floor errs by the square of a step") {
  const auto pushed = [](double h) {
    WorldDef def = steps(1.0, h);
    def.bodies = {ground(0.0, 0.3), box("box", {0.2, 0.2, 0.2}, {0.0, 0.1, 0.0}, 0.0, 0.3)};
    def.forces = {PointForce{.body = 1, .point_B = {0.0, 0.0, 0.05}, .force = {40.0, 0.0, 0.0}}};
    return def;
  };
  World reference(byCourse(pushed(1.0 / 240.0)));
  reference.advance(1.0);
  const Vec3 there = reference.sample(1.0).bodies[1].x;
  std::vector<double> off, audit;
  for (const double h : {1.0 / 60.0, 1.0 / 120.0, 1.0 / 240.0}) {
    World world(pushed(h));
    world.advance(1.0);
    off.push_back((world.sample(1.0).bodies[1].x - there).norm());
    audit.push_back(world.report().certificate.audit_energy_error);
    CHECK(world.report().certificate.energy_balance_error < 1e-12);
  }
  for (const std::vector<double>& errors : {off, audit}) {
    CAPTURE(errors);
    CHECK(errors.back() < 2e-6);
    for (int k : {0, 1}) {
      CHECK(errors[k] > 3.5 * errors[k + 1]);
      CHECK(errors[k] < 4.5 * errors[k + 1]);
    }
  }
}

// Oracle: x = rest + A cos ωt, on a floor without friction. Areas are kept, so that the amplitude
// stays; the phase errs by (ωh)²/12 of ωt, and so x by 8.7e-4 m within 2 s. Measured 3e-4 m
// and 8.0e-4 m.
TEST_CASE("a box that slides to and fro on a spring keeps its amplitude and its time") {
  WorldDef def = steps(20.0);
  def.bodies = {ground(), box("box", {0.2, 0.2, 0.2}, {0.8, 0.1, 0.0})};
  Spring spring{.a = 1, .stiffness = 800.0, .rest = 0.5};
  spring.anchorB_B = {0.0, 0.1, 0.0};
  def.forces = {spring};
  World world(def);
  double highest = 0.0, lowest = 1.0, off = 0.0;
  for (int k = 1; k <= 1200; ++k) {
    world.advance(k / 60.0);
    const double x = world.sample(k / 60.0).bodies[1].x.x();
    if (k <= 120) off = std::max(off, std::abs(x - 0.5 - 0.3 * std::cos(k / 6.0)));
    if (k > 1000) highest = std::max(highest, x), lowest = std::min(lowest, x);
  }
  CHECK(off < 1e-3);
  CHECK(highest == Approx(0.8).margin(1e-3));
  CHECK(lowest == Approx(0.2).margin(1e-3));
}

// Oracle: binary numbers, in which all of this is exact. A box slides so that the ends of a spring,
// too soft to change anything, come together in the middle of its third step.
TEST_CASE("a spring that has no length in the middle of a step has the direction of its start") {
  WorldDef def = steps(0.1);
  def.stepping.step = 0x1p-8;
  def.gravity.setZero();
  def.bodies = {ground(), box("box", {0.25, 0.25, 0.25}, {0x1.4p-5, 0.125, 0.0})};
  def.bodies[1].velocity = {-4.0, 0.0, 0.0};
  Spring spring{.a = 1, .stiffness = 1e-20};
  spring.anchorB_B = {0.0, 0.125, 0.0};
  def.forces = {spring};
  World world(def);
  const Sample end = run(world);
  CHECK(end.bodies[1].v == Vec3(-4.0, 0.0, 0.0));
  CHECK(end.bodies[1].x.y() == 0.125);
  CHECK(world.report().notes.empty());
}

// Oracle: two particles on a spring turn and swing about their centre, whose path is a parabola;
// P by weight alone, L constant. Measured 4e-14; allowed 1e-11.
TEST_CASE("what a spring joins keeps its common momenta") {
  WorldDef def = steps(5.0);
  def.bodies = {box("a", {0.2, 0.1, 0.3}, {0.0, 0.0, 0.0}),
                box("b", {0.1, 0.1, 0.2}, {1.2, 0.1, 0.0})};
  def.bodies[0].velocity = {0.0, 1.0, 0.0};
  def.bodies[1].angularVelocity = {3.0, 1.0, 0.0};
  Spring spring{.a = 0, .b = 1, .stiffness = 300.0, .rest = 1.0};
  spring.anchorA_B = {0.1, 0.05, 0.0};
  spring.anchorB_B = {-0.05, 0.0, 0.1};
  def.forces = {spring};
  World world(def), reference(byCourse(def));
  const Sample end = run(world), expected = run(reference);
  for (int i = 0; i < 2; ++i) {
    CHECK((end.bodies[i].x - expected.bodies[i].x).norm() < 1e-8);
    CHECK((end.bodies[i].omega - expected.bodies[i].omega).norm() < 1e-7);
  }
  CHECK(world.report().certificate.momentum_error < 1e-12);
  CHECK(world.report().certificate.energy_balance_error < 1e-10);
}

// Oracle: the closed form of `exact`. Measured 2e-13 rad after 10 s at any step, allowed 1e-10.
TEST_CASE("a brick that flips about its middle axis flips in steps as in closed form") {
  for (const double h : {1.0 / 30.0, 1.0 / 240.0}) {
    CAPTURE(h);
    WorldDef def = steps(10.0, h);
    def.gravity.setZero();
    def.bodies = {box("brick", {0.1, 0.2, 0.3}, Vec3::Zero())};
    def.bodies[0].angularVelocity = {0.0, 10.0, 1e-3};
    WorldDef closed = def;
    closed.method = "exact";
    World world(def), reference(closed);
    const Sample end = run(world), expected = run(reference);
    CHECK(end.bodies[0].q.angularDistance(expected.bodies[0].q) < 1e-10);
  }
}

// Oracle: what sticks to a turntable goes where the table goes, one box on another too. Measured
// 2e-13 m after a minute at either step, allowed 1e-6 m.
TEST_CASE("boxes that stick on a turntable go round with it at any step") {
  for (const double h : {1.0 / 60.0, 1.0 / 240.0}) {
    CAPTURE(h);
    WorldDef def = steps(60.0, h);
    def.bodies = {turntable(1.5, 0.5), box("low", {0.1, 0.1, 0.1}, {0.5, 0.05, 0.0}, 0.0, 0.5),
                  box("high", {0.1, 0.1, 0.1}, {0.52, 0.15, 0.02}, 0.0, 0.5)};
    for (int i : {1, 2}) {
      def.bodies[i].angularVelocity = {0.0, 1.5, 0.0};
      def.bodies[i].velocity = def.bodies[i].angularVelocity.cross(def.bodies[i].position);
    }
    World world(def);
    const Sample end = run(world);
    const Quat turned = fromAxisAngle(Vec3::UnitY(), 90.0);
    for (int i : {1, 2}) CHECK((end.bodies[i].x - turned * def.bodies[i].position).norm() < 1e-6);
  }
}
