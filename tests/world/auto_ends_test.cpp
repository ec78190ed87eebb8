// Scenes in which events crowd, or no forces are found: the method "auto" ends, and its books
// close.
#include <algorithm>
#include <cmath>

#include "sim/problem/problem.h"
#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

WorldDef bouncingStack() {
  WorldDef def = worldOf("auto", 1.5, {ground(0.5, 0.3)});
  addColumn(def, 4, 0.4, {0.0, 0.4, 0.0}, 0.5, 0.3);
  return def;
}

/// A box of which half reaches over the rim of a table that turns.
WorldDef rim() {
  WorldDef def = worldOf("auto", 1.5, {ground(0.0, 0.5)});
  BodyDef& table = def.bodies[0];
  table.shape = Cylinder{3.0, 0.1};
  table.position = {0.0, -0.1, 0.0};
  table.angularVelocity = {0.0, 2.0, 0.0};
  def.bodies.push_back(box("box", {0.4, 0.4, 0.4}, {3.0, 0.2, 0.0}, 0.0, 0.5));
  return def;
}

/// A box a hundred times as heavy as each of the others falls on a tower of so many.
WorldDef hammer(int boxes) {
  WorldDef def = worldOf("auto", 1.5, {ground(0.1, 0.5)});
  addColumn(def, boxes, 0.4, {0.0, 0.2, 0.0}, 0.1, 0.5);
  BodyDef heavy = box("heavy", {0.6, 0.6, 0.6}, {0.1, 0.4 * boxes + 1.2, 0.05}, 0.1, 0.5);
  heavy.mass = 6400.0;
  heavy.orientation = fromAxisAngle(Vec3(1.0, 0.3, 0.5).normalized(), 0.5);
  def.bodies.push_back(heavy);
  return def;
}

/// Two cubes of which the lower one is pushed; friction is more than sliding has forces for.
WorldDef pushed() {
  WorldDef def = worldOf("auto", 1.5, {ground(0.0, 3.0)});
  addColumn(def, 2, 0.2, {0.0, 0.1, 0.0}, 0.0, 3.0);
  def.bodies[1].velocity = {1.0, 0.0, 0.0};
  return def;
}

struct Crowd {
  const char* name;
  WorldDef def;
  double overlap = 1e-9, balance = 0.05;  ///< [m] and [1] that are allowed
};

void requireSoundEnd(const Crowd& crowd) {
  World world(crowd.def);
  run(world);
  const Certificate& books = world.report().certificate;
  CAPTURE(crowd.name, world.method(), books.max_penetration, books.max_complementarity,
          books.momentum_error, books.energy_balance_error);
  CHECK_FALSE(world.report().stopped);
  CHECK(books.max_penetration < crowd.overlap);
  CHECK(books.max_complementarity < 1e-6);
  CHECK(books.momentum_error < 1e-9);
  CHECK(books.energy_balance_error < crowd.balance);
  const std::vector<Event>& events = world.report().events;
  CHECK(std::is_sorted(events.begin(), events.end(),
                       [](const Event& p, const Event& q) { return p.t < q.t; }));
}

}  // namespace

// Oracle: closed form and conservation. A stack that falls as one meets the floor at sqrt(2 d/g),
// and no forces act in it before. Measured: to the last digit; energy closed to 2e-11.
TEST_CASE("exact: boxes that touch fall as one and bounce on the floor") {
  WorldDef def = bouncingStack();
  def.method = "exact";
  for (std::size_t i = 1; i < def.bodies.size(); ++i) def.bodies[i].position.y() = 0.4 * i;
  World world(def);
  run(world);
  const Report& report = world.report();
  const auto hit = std::find_if(report.events.begin(), report.events.end(),
                                [](const Event& e) { return e.kind == EventKind::Impact; });
  CHECK_FALSE(report.stopped);
  REQUIRE(hit != report.events.end());
  CHECK(std::abs(hit->t - std::sqrt(0.4 / 9.81)) < 1e-12);
  CHECK(report.certificate.max_penetration < 1e-12);
  CHECK(report.certificate.energy_balance_error < 1e-9);
}

// Oracle: conservation, and the surfaces. Measured: overlap 3e-10 m, residual 2e-9, momentum 3e-11;
// of the energy a hundredth of what moves most. A box alone stays with the exact method, whose
// steps across events overlap by up to 2.4e-7 m before they are mended; its energy closes to 1e-10.
TEST_CASE("auto brings crowds of events to an end, and its certificate is sound") {
  requireSoundEnd(GENERATE(Crowd{"stack", bouncingStack()}, Crowd{"rim", rim(), 1e-6, 1e-9},
                           Crowd{"hammer", hammer(1)}, Crowd{"pushed", pushed()}));
}

// The same. Boxes that the heavy one sends apart are a crowd in motion, which the preset "auto"
// leaves to sweeps: the bounds are those of "exact". Measured: overlap 8e-15 m, residual 4e-9.
TEST_CASE("auto brings a heavy box that falls on a tower of five to an end", "[long]") {
  WorldDef def = hammer(5);
  def.stepping.take(*findSolverPreset("exact"));
  requireSoundEnd({"hammer", def});
}
