// The course's method on scenes with closed forms.
#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

WorldDef courseWorld(double duration) {
  WorldDef def;
  def.method = "course";
  def.duration = duration;
  return def;
}

std::vector<Event> impacts(const World& world) {
  std::vector<Event> list;
  for (const Event& e : world.report().events)
    if (e.kind == EventKind::Impact) list.push_back(e);
  return list;
}

}  // namespace

// Oracle: t_n = t1 (1 + 2 Σ e^k) for a ball dropped from h. Measured 2e-12 s, allowed 1e-10 s.
TEST_CASE("a dropped ball hits the floor at the times of the geometric series") {
  for (double e : {0.3, 0.8, 1.0}) {
    CAPTURE(e);
    WorldDef def = courseWorld(6.0);
    def.bodies = {ground(), ball("ball", 0.1, {0.0, 2.1, 0.0}, e)};
    World world(def);
    run(world);
    const double t1 = std::sqrt(2.0 * 2.0 / 9.81);
    double t = t1, flight = 2.0 * t1 * e;
    const std::vector<Event> hits = impacts(world);
    REQUIRE(hits.size() >= 4);
    for (int k = 0; k < 4; ++k) {
      CHECK(hits[k].t == Approx(t).margin(1e-10));
      t += flight;
      flight *= e;
    }
    CHECK_FALSE(world.report().stopped);
  }
}

// Oracle: t∞ = t1 (1+e)/(1−e). Zeno's bounces end in rest; measured 1e-6 s, allowed 1e-5 s.
TEST_CASE("bounces accumulate and go over into lasting contact") {
  for (double e : {0.2, 0.5, 0.8}) {
    CAPTURE(e);
    WorldDef def = courseWorld(7.0);
    def.bodies = {ground(), box("brick", {0.4, 0.1, 0.3}, {0.0, 2.05, 0.0}, e)};
    World world(def);
    const Sample end = run(world);
    double rest = -1.0;
    for (const Event& event : world.report().events)
      if (event.kind == EventKind::Rest) rest = event.t;
    const double t1 = std::sqrt(2.0 * 2.0 / 9.81);
    CHECK(rest == Approx(t1 * (1.0 + e) / (1.0 - e)).margin(1e-5));
    CHECK(end.bodies[1].x.y() == Approx(0.05).margin(1e-9));
    CHECK(end.bodies[1].v.norm() < 1e-9);
    CHECK(world.report().certificate.energy_balance_error < 1e-9);
  }
}

// Oracle: f = m g. Measured 1e-15 relative, allowed 1e-10.
TEST_CASE("the forces under a resting brick add up to its weight") {
  WorldDef def = courseWorld(1.0);
  def.bodies = {ground(), box("brick", {0.4, 0.1, 0.3}, {0.0, 0.05, 0.0})};
  World world(def);
  const Sample end = run(world);
  Vec3 sum = Vec3::Zero();
  for (const ContactSample& c : end.contacts) sum += c.force;
  CHECK(end.contacts.size() == 4);
  CHECK((sum - Vec3(0.0, 12.0 * 9.81, 0.0)).norm() < 1e-10 * 12.0 * 9.81);
  CHECK(end.bodies[1].v.norm() < 1e-12);
}

// Oracle: a = g (sin θ − mu cos θ) on a slope made by tilting gravity; s = ½ a t².
// Measured 1e-13 m, allowed 1e-9 m.
TEST_CASE("a block slides down a slope iff it is steeper than its friction") {
  const double angle = 0.5, g = 9.81;
  for (double mu : {0.0, 0.3, 0.54, 0.55, 0.8}) {
    CAPTURE(mu);
    WorldDef def = courseWorld(1.0);
    def.gravity = {g * std::sin(angle), -g * std::cos(angle), 0.0};
    def.bodies = {ground(0.0, mu), box("block", {0.4, 0.1, 0.3}, {0.0, 0.05, 0.0}, 0.0, mu)};
    World world(def);
    const Sample end = run(world);
    const double a = std::max(0.0, g * (std::sin(angle) - mu * std::cos(angle)));
    CHECK(end.bodies[1].x.x() == Approx(0.5 * a).margin(1e-9));
    CHECK(std::abs(end.bodies[1].x.z()) < 1e-9);
    CHECK(world.report().certificate.energy_balance_error < 1e-9);
  }
}

// Oracle: stops after v²/(2 mu g) and stays. Measured 1e-12 m, allowed 1e-9 m.
TEST_CASE("a sliding block stops where Coulomb says and does not turn back") {
  WorldDef def = courseWorld(2.0);
  def.bodies = {ground(0.0, 0.5), box("block", {0.4, 0.1, 0.3}, {0.0, 0.05, 0.0}, 0.0, 0.5)};
  def.bodies[1].velocity = {1.2, 0.0, 1.6};
  World world(def);
  const Sample end = run(world);
  const double way = 4.0 / (2.0 * 0.5 * 9.81);
  CHECK(end.bodies[1].x.x() == Approx(0.6 * way).margin(1e-9));
  CHECK(end.bodies[1].x.z() == Approx(0.8 * way).margin(1e-9));
  CHECK(end.bodies[1].v.norm() < 1e-9);
  const Certificate& c = world.report().certificate;
  CHECK(c.energy_lost_friction == Approx(0.5 * 12.0 * 4.0).epsilon(1e-9));
}

// Oracle: a ball that starts sliding at v0 rolls from t = 2 v0/(7 mu g) on, at 5/7 v0.
// Measured 1e-12, allowed 1e-9.
TEST_CASE("a sliding ball begins to roll when its slip is used up") {
  const double v0 = 5.0, mu = 0.3;
  WorldDef def = courseWorld(1.0);
  def.bodies = {ground(0.0, mu), ball("ball", 0.2, {0.0, 0.2, 0.0}, 0.0, mu)};
  def.bodies[1].velocity = {v0, 0.0, 0.0};
  World world(def);
  const Sample end = run(world);
  CHECK(end.bodies[1].v.x() == Approx(5.0 / 7.0 * v0).margin(1e-9));
  CHECK(end.bodies[1].omega.z() == Approx(-5.0 / 7.0 * v0 / 0.2).margin(1e-8));
  double stick = -1.0;
  for (const Event& event : world.report().events)
    if (event.kind == EventKind::Stick) stick = event.t;
  CHECK(stick == Approx(2.0 * v0 / (7.0 * mu * 9.81)).margin(1e-9));
}

// Oracle: bit equality. Where a run is looked at never changes it.
TEST_CASE("sampling never changes the motion") {
  const auto lastOf = [](const char* method, double rate) {
    WorldDef def = courseWorld(1.5);
    def.method = method;
    def.bodies = {ground(0.0, 0.3), box("brick", {0.4, 0.1, 0.3}, {0.0, 1.0, 0.0}, 0.5, 0.3),
                  box("slider", {0.4, 0.1, 0.3}, {2.0, 0.05, 0.0}, 0.0, 0.3)};
    def.bodies[1].orientation = fromAxisAngle({0.3, 0.2, 1.0}, 0.5);
    def.bodies[2].velocity = {1.0, 0.0, 0.4};
    def.bodies[2].angularVelocity = {0.0, 5.0, 0.0};
    World world(def);
    for (int k = 0; k / rate < 1.5; ++k) {
      world.advance(k / rate);
      world.sample(k / rate);
    }
    world.advance(1.5);
    return world.sample(1.5);
  };
  for (const char* method : {"course", "stepping"}) {
    CAPTURE(method);
    const Sample one = lastOf(method, 60.0), two = lastOf(method, 7.3);
    for (int i : {1, 2}) {
      CHECK(one.bodies[i].x == two.bodies[i].x);
      CHECK(one.bodies[i].q.coeffs() == two.bodies[i].q.coeffs());
      CHECK(one.bodies[i].omega == two.bodies[i].omega);
    }
  }
}

// Oracle: the certificate itself, on a scene that falls, bounces, slides, rattles and is blown by
// wind. Momentum measured 2e-13, allowed 1e-10. Where a step holds more events than can be located,
// some are seen late: measured 6e-5 m of overlap, allowed 1e-3 m.
TEST_CASE("momentum changes only by what acts from outside") {
  WorldDef def = courseWorld(1.0);
  def.bodies = {ground(0.0, 0.4), box("lower", {0.5, 0.5, 0.5}, {0.0, 0.6, 0.0}, 0.4, 0.4),
                box("upper", {0.3, 0.2, 0.4}, {0.1, 1.3, 0.05}, 0.4, 0.4),
                ball("ball", 0.1, {1.0, 0.5, 0.0}, 0.4, 0.4)};
  def.forces = {UniformWind{3, {2.0, 0.0, 1.0}}};
  World world(def);
  run(world);
  CHECK_FALSE(world.report().stopped);
  CHECK(world.report().certificate.momentum_error < 1e-10);
  CHECK(world.report().certificate.max_penetration < 1e-3);
}

// Oracle: Newton's law in one dimension. A coarse step must not let a ball jump through a plate.
TEST_CASE("a fast ball does not pass through a thin plate") {
  WorldDef def = courseWorld(0.1);
  def.gravity.setZero();
  def.course.step = 0.05;
  BodyDef plate = box("plate", {0.01, 2.0, 2.0}, {0.0, 0.0, 0.0}, 1.0);
  plate.fixed = true;
  def.bodies = {plate, ball("ball", 0.02, {-1.0, 0.1, 0.0}, 1.0)};
  def.bodies[1].velocity = {50.0, 0.0, 0.0};
  World world(def);
  const Sample end = run(world);
  CHECK(end.bodies[1].v.x() == Approx(-50.0).epsilon(1e-12));
  REQUIRE(impacts(world).size() == 1);
  CHECK(impacts(world)[0].t == Approx(0.975 / 50.0).epsilon(1e-12));  // measured 2e-15
}

// Oracle: the same. However fast, thin and small.
TEST_CASE("a bullet does not pass through a sheet") {
  for (const double speed : {1e3, 5e4, 1e6})
    for (const double turn : {0.0, 0.4}) {
      WorldDef def = courseWorld(1.0 / speed);
      def.gravity.setZero();
      def.course.step = std::min(1.0 / 240.0, def.duration);
      BodyDef sheet = box("sheet", {0.001, 2.0, 2.0}, {0.0, 0.0, 0.0}, 1.0);
      sheet.fixed = true;
      def.bodies = {sheet, ball("ball", 0.01, {-0.5, 0.01, 0.02}, 1.0)};
      const Quat q = fromAxisAngle({0, 0, 1}, turn);
      for (BodyDef& body : def.bodies) {
        body.position = q * body.position;
        body.orientation = q;
      }
      def.bodies[1].velocity = q * Vec3(speed, 0.0, 0.0);
      World world(def);
      const Sample end = run(world);
      CAPTURE(speed, turn);
      REQUIRE(impacts(world).size() == 1);
      CHECK(impacts(world)[0].t * speed == Approx(0.4895).epsilon(1e-9));  // measured 4e-10
      CHECK((q.conjugate() * end.bodies[1].v).x() == Approx(-speed).epsilon(1e-12));
    }
}

// Oracle: a corner of a spinning rod sweeps a circle. It reaches 1 mm below the floor only between
// two coarse steps; the hit must be found at the time at which the circle crosses the floor.
TEST_CASE("a corner that dips in and out within a step is caught at its entry") {
  const double half = 0.5, spin = 10.0, below = 1e-3;
  WorldDef def = courseWorld(0.2);
  def.gravity.setZero();
  def.course.step = 0.2;
  def.course.integrator = "dopri5";
  def.bodies = {ground(1.0), box("rod", {2.0 * half, 0.02, 0.02}, {0.0, 0.0, 0.0}, 1.0)};
  const double radius = std::hypot(half, 0.01), tilt = std::atan2(0.01, half);
  def.bodies[1].position.y() = radius - below;
  def.bodies[1].angularVelocity = {0.0, 0.0, -spin};
  // The right end points down and sweeps left: it is at its lowest after 0.2 rad.
  const double lead = 0.2;
  def.bodies[1].orientation = fromAxisAngle({0, 0, 1}, -0.5 * 3.14159265358979323846 + tilt + lead);
  World world(def);
  run(world);
  REQUIRE_FALSE(impacts(world).empty());
  const double entry = (lead - std::acos((radius - below) / radius)) / spin;
  CHECK(impacts(world)[0].t == Approx(entry).margin(1e-9));  // measured 3e-11
}

// Oracle: the definition of a step; 1 rad each.
TEST_CASE("where nothing can be met, the author's step is taken however fast a body spins") {
  WorldDef def;
  def.method = "course";
  def.gravity.setZero();
  def.duration = 1.0;
  def.course.step = 0.01;
  def.bodies = {box("top", {0.1, 0.2, 0.3}, Vec3::Zero())};
  def.bodies[0].angularVelocity = {0.0, 0.0, 100.0};
  World world(def);
  world.advance(1.0);
  CHECK(world.report().certificate.steps == 100);
}
