// Sliding that no forces go with (Painlevé), where bodies touch at more than one point: an impulse
// without collision ends it, held to closed forms.
#include <algorithm>
#include <cmath>

#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

/// A block of half lengths l along its slip and h across it, which slides at 1 m/s on one of its
/// long faces, or on the edge below it. Its centre is at height `above`.
WorldDef slider(const char* method, double duration, double mu, double l, double h, double above) {
  WorldDef def = worldOf(method, duration, {ground(0.0, mu)});
  def.bodies.push_back(box("block", 2.0 * Vec3(l, h, h), {0.0, above, 0.0}, 0.0, mu));
  if (above > h) def.bodies[1].orientation = fromAxisAngle(Vec3::UnitX(), 0.25 * std::numbers::pi);
  def.bodies[1].velocity = {1.0, 0.0, 0.0};
  return def;
}

/// Turns about its front points, which stop: ω = v H/(k² + l² + H²), k the radius of inertia, with
/// the impulse m ω l along the normal. The share H²/(k² + l² + H²) of the energy is left.
void checkStop(const WorldDef& def, double l, double h, double above) {
  World world(def);
  world.advance(def.duration);
  const Report& report = world.report();
  CAPTURE(report.reason, report.certificate.energy_balance_error);
  REQUIRE_FALSE(report.stopped);
  const double mass = 8000.0 * l * h * h;
  const double inertia = (l * l + h * h) / 3.0 + l * l + above * above;
  const double omega = above / inertia;
  REQUIRE(!report.events.empty());
  const Event& jam = report.events.front();
  CHECK(jam.t == 0.0);
  CHECK(jam.kind == EventKind::Impact);
  CHECK(jam.vrel == 0.0);
  CHECK(jam.p.x() == Approx(l).epsilon(1e-12));
  CHECK(jam.j == Approx(mass * omega * l).epsilon(1e-12));
  CHECK(report.certificate.energy_lost_friction ==
        Approx(0.5 * mass * (1.0 - above * above / inertia)).epsilon(1e-12));
  CHECK(report.certificate.energy_balance_error < 1e-12);
  CHECK(report.notes.size() == 1);
}

}  // namespace

// Oracle: closed form. A block that slides along the edge it stands on jams if mu is more than
// (k² + l²)/(l H), at its front corner alone: W = (3.3, 2.1; −1.3, −0.1)/m leaves nothing that
// could push it up there, while both together would be pushed, the rear corner down. Measured
// 2e-15.
TEST_CASE("a block that slides along its edge jams at the front corner alone") {
  const double l = 0.1, h = 0.2, above = h * std::sqrt(2.0);
  checkStop(slider("exact", 0.01, 1.0, l, h, above), l, h, above);
  World smooth(slider("exact", 0.01, 0.9, l, h, above));  // (k² + l²)/(l H) = 0.943
  smooth.advance(0.01);
  CHECK_FALSE(smooth.report().stopped);
  CHECK(smooth.report().notes.empty());
}

// Oracle: closed form. A cube that slides on a face jams at its front edge where mu > 5/3, rises,
// and falls back. Measured: 2e-15, and at rest to 4e-19 m/s; momentum 2e-10, as the forces of the
// rest are solved to 2e-11 of the weight.
TEST_CASE("a cube whose sliding jams tips about its front edge, and comes to rest") {
  const double l = 0.1;
  for (const double mu : {2.0, 3.0, 10.0}) {
    CAPTURE(mu);
    checkStop(slider("exact", 0.01, mu, l, l, l), l, l, l);
    World world(slider("auto", 1.0, mu, l, l, l));
    world.advance(1.0);
    const Sample end = world.sample(1.0);
    const Certificate& books = world.report().certificate;
    CHECK_FALSE(world.report().stopped);
    CHECK(world.method() == "auto: exact");
    CHECK(std::abs(end.bodies[1].x.y() - l) < 1e-9);
    CHECK(end.bodies[1].v.norm() < 1e-9);
    CHECK(books.energy_end <= books.energy_start);
    CHECK(books.max_complementarity < 1e-6);
    CHECK(books.momentum_error < 1e-9);
  }
}

// Oracle: friction gives no energy. A plank in the corner of floor and wall, and slabs that slide
// on each other, jam at several places; where that leads to friction that would give, as among the
// slabs, a step with impulses goes on, and a note says so. Measured 3e-14 J, allowed 1e-9 J of 45
// and 271 J.
TEST_CASE("where jams at several places have no forces, a step with impulses goes on") {
  BodyDef wall = ground(0.0, 1.0);
  wall.name = "wall";
  wall.shape = HalfSpace{{1.0, 0.0, 0.0}, 0.0};
  BodyDef plank =
      box("plank", {1.0, 0.05, 0.2}, {0.27165063609461104, 0.44551270289221934, 0.0}, 0.0, 1.0);
  plank.orientation = fromAxisAngle(Vec3::UnitZ(), -std::numbers::pi / 3.0);
  plank.velocity = {0.4455127018922193, -0.271650635094611, 0.0};
  plank.angularVelocity = {0.0, 0.0, 1.0};
  const WorldDef ladder = worldOf("exact", 0.5, {ground(0.0, 1.0), wall, plank});

  WorldDef slabs = worldOf("exact", 0.1, {ground(0.0, 3.0)});
  const Vec3 velocities[] = {{4.0, 0.0, 0.0}, {2.0, 0.0, 0.5}, {0.0, 0.0, 1.0}};
  for (int k = 0; k < 3; ++k) {
    slabs.bodies.push_back(
        box("slab" + std::to_string(k), {0.6, 0.1, 0.3}, {0.0, 0.05 + 0.1 * k, 0.0}, 0.0, 3.0));
    slabs.bodies.back().velocity = velocities[k];
  }
  for (const auto& [def, lawless] : {std::pair(ladder, false), {slabs, true}}) {
    World world(def);
    world.advance(def.duration);
    const Report& report = world.report();
    CAPTURE(report.reason, report.certificate.max_energy_gain);
    CHECK_FALSE(report.stopped);
    const bool noted =
        std::any_of(report.notes.begin(), report.notes.end(), [](const std::string& note) {
          return note.find("right to first order") != std::string::npos;
        });
    CHECK(noted == lawless);
    CHECK(report.certificate.max_energy_gain < 1e-9);
    CHECK(report.certificate.energy_balance_error < 1e-9);
  }
}

namespace {

/// A rod of 1 m that leans 25 degrees and is thrown at 5 m/s ahead of its two lower corners, in a
/// world that is turned.
WorldDef leaningRod(const char* method, const Quat& turn) {
  const double w = 0.02, lean = 25.0 * std::numbers::pi / 180.0;
  WorldDef def = worldOf(method, 0.3, {ground(0.0, 5.0)});
  def.gravity = turn * def.gravity;
  def.bodies[0].shape = HalfSpace{turn * Vec3::UnitY()};
  const double height = 0.5 * std::cos(lean) + 0.5 * w * std::sin(lean);
  def.bodies.push_back(box("rod", {w, 1.0, w}, turn * Vec3(0.0, height, 0.0), 0.0, 5.0));
  def.bodies[1].orientation = turn * fromAxisAngle(Vec3::UnitZ(), lean);
  def.bodies[1].velocity = turn * Vec3(5.0, 0.0, 0.0);
  return def;
}

/// A cart of 2 kg on a rail, from which a rod of 1 kg hangs at a hinge 25 degrees ahead of the
/// vertical, its foot on the floor; both go at 3 m/s along x, which is turned about the vertical.
WorldDef cartWithRod(double mu, double turned) {
  const double length = 1.0, lean = 25.0 * std::numbers::pi / 180.0, r = 1e-9;
  const Quat turn = fromAxisAngle(Vec3::UnitY(), turned);
  const Vec3 along = turn * Vec3::UnitX(), speed = 3.0 * along;
  const Vec3 rod = turn * Vec3(std::sin(lean), -std::cos(lean), 0.0);
  const Vec3 hinge(0.0, length * std::cos(lean) + r, 0.0);
  WorldDef def = worldOf("course", 0.1, {ground(0.0, mu)});
  BodyDef cart = box("cart", {0.2, 0.1, 0.1}, hinge);
  cart.density.reset();
  cart.mass = 2.0;
  BodyDef leg = ball("leg", r, hinge + 0.5 * length * rod, 0.0, mu);
  leg.shape = Capsule{r, length};
  leg.orientation = turn * fromAxisAngle(Vec3::UnitZ(), lean);
  leg.inertia = Vec3(1.0 / 12.0, 1e-4, 1.0 / 12.0);
  cart.velocity = leg.velocity = speed;
  def.bodies.push_back(cart);
  def.bodies.push_back(leg);
  def.joints = {{.name = "rail",
                 .kind = JointKind::Slider,
                 .a = 1,
                 .anchorA = hinge,
                 .anchorB = hinge,
                 .axis = along},
                {.name = "hip",
                 .kind = JointKind::Hinge,
                 .a = 2,
                 .b = 1,
                 .anchorA = hinge,
                 .anchorB = hinge,
                 .axis = turn * Vec3::UnitZ()}};
  return def;
}

bool tellsOfJam(const Report& report) {
  return std::any_of(report.notes.begin(), report.notes.end(),
                     [](const std::string& note) { return note.find("jammed") < note.size(); });
}

}  // namespace

// Oracle: symmetry, and two methods. A rod that is thrown in a plane stays in it, however plane and
// floor are turned, and goes where the exact method has it. Measured 5.6e-13 and 1.5e-15 m.
TEST_CASE("in the course a thrown rod jams, and stays in its plane") {
  const Quat leaning = fromAxisAngle(Vec3(1.0, 2.0, -0.5).normalized(), 0.8);
  const Quat about = fromAxisAngle(Vec3::UnitY(), 0.6);
  const Quat back = fromAxisAngle(Vec3::UnitY(), std::numbers::pi);
  for (const Quat& turn : {Quat::Identity(), back, about, leaning}) {
    const WorldDef def = leaningRod("course", turn);
    World course(def), exact(leaningRod("exact", turn));
    const Vec3 end = run(course).bodies[1].x, there = run(exact).bodies[1].x;
    const Report& report = course.report();
    const double off = std::abs((turn.conjugate() * end).z()), apart = (end - there).norm();
    CAPTURE(off, apart, report.certificate.max_complementarity);
    CHECK_FALSE(report.stopped);
    CHECK(off < 1e-12);
    CHECK(apart < 1e-12);
    CHECK(report.notes.size() == 1);
    CHECK(tellsOfJam(report));
    CHECK(report.certificate.max_complementarity < 1e-8);
    CHECK(report.certificate.energy_balance_error < 1e-9);
  }
}

// Oracle: closed form. With A = 3 kg all that moves along the rail and B = ½ m l cos θ, the foot's
// push moves it down where A l (mu cos θ − sin θ) > B mu: for mu > 0.5596. Its jam ends all that
// moves, so that friction takes ½ A v². Measured 13.5 J to 5e-10.
TEST_CASE("in the course a rod that a cart pushes ahead of it jams, and the cart stops") {
  for (const double turned : {0.0, 0.6, std::numbers::pi})
    for (const double mu : {0.55, 0.57, 1.0, 3.0}) {
      World world(cartWithRod(mu, turned));
      const Sample end = run(world);
      const Report& report = world.report();
      CAPTURE(turned, mu, report.reason, report.certificate.energy_lost_friction);
      CHECK_FALSE(report.stopped);
      CHECK(tellsOfJam(report) == (mu > 0.5596));
      CHECK(report.certificate.energy_balance_error < 1e-6);
      if (mu < 0.5596) continue;
      CHECK(report.certificate.energy_lost_friction == Approx(0.5 * 3.0 * 9.0).epsilon(1e-9));
      CHECK(end.bodies[1].v.norm() < 1e-9);
      CHECK(end.bodies[2].omega.norm() < 1e-9);
    }
}
