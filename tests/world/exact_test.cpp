// The exact method: closed-form flight, and a stop where bodies meet.
#include <algorithm>
#include <charconv>

#include "sim/collide/collide.h"
#include "tests/catch.h"
#include "tests/collide/random_pose.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

// The instant that the reason of a stop names.
double stopTime(const World& world) {
  const std::string& reason = world.report().reason;
  const std::size_t at = reason.find("t = ");
  REQUIRE(at != std::string::npos);
  double t = -1.0;
  std::from_chars(reason.data() + at + 4, reason.data() + reason.size(), t);
  return t;
}

BodyDef spinner(const std::string& name, const Vec3& x, const Vec3& v, const Vec3& omega) {
  BodyDef def = box(name, {0.2, 0.5, 0.2}, x);
  def.velocity = v;
  def.angularVelocity = omega;
  return def;
}

}  // namespace

// Oracle: x = x0 + v t + ½ (g + F/m) t², and a cylinder's spin about its axis. Measured 4e-18
// relative, allowed 1e-14; the books close to rounding.
TEST_CASE("a lone body flies along its parabola for any time, and the books close") {
  for (const double duration : {1.0, 1e3, 1e6}) {
    CAPTURE(duration);
    WorldDef def = exactWorld(duration);
    def.bodies = {spinner("top", {1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, {0.0, 7.0, 0.0})};
    def.forces = {UniformWind{kNoBody, {2.0, 0.0, -1.0}}};
    World world(def);
    world.advance(duration);
    const Sample end = world.sample(duration);
    const double m = 1000.0 * 0.2 * 0.5 * 0.2;
    const Vec3 a = def.gravity + Vec3(2.0, 0.0, -1.0) / m;
    const Vec3 x = Vec3(1.0, 2.0, 3.0) + duration * (Vec3(4.0, 5.0, 6.0) + 0.5 * duration * a);
    CHECK((end.bodies[0].x - x).norm() <= 1e-14 * x.norm());
    CHECK((end.bodies[0].v - Vec3(4.0, 5.0, 6.0) - duration * a).norm() <=
          1e-14 * end.bodies[0].v.norm());
    CHECK((end.bodies[0].omega - Vec3(0.0, 7.0, 0.0)).norm() < 1e-13);
    const Report& report = world.report();
    CHECK_FALSE(report.stopped);
    CHECK(report.events.empty());
    CHECK(report.certificate.steps == 1);
    CHECK(report.certificate.energy_balance_error < 1e-12);
    CHECK(report.certificate.momentum_error < 1e-12);
    CHECK(report.certificate.work_of_forces != 0.0);
  }
}

// Oracle: two methods. The course with Dormand and Prince's rule at 1/960 s; measured 2.2e-13,
// allowed 1e-11.
TEST_CASE("exact flight and the course's integration agree") {
  const auto endOf = [](const char* method) {
    WorldDef def = exactWorld(2.0);
    def.method = method;
    def.course.integrator = "dopri5";
    def.course.step = 1.0 / 960.0;
    def.bodies = {spinner("one", {0.0, 0.0, 0.0}, {1.0, 2.0, 0.0}, {3.0, 4.0, 5.0}),
                  ball("two", 0.1, {3.0, 0.0, 0.0})};
    def.bodies[1].angularVelocity = {1.0, -2.0, 3.0};
    def.forces = {UniformWind{1, {0.3, 0.0, 0.0}}, PointForce{0, Vec3::Zero(), {0.0, 1.0, 2.0}}};
    World world(def);
    return run(world);
  };
  const Sample exact = endOf("exact"), course = endOf("course");
  for (int i : {0, 1}) {
    CHECK((exact.bodies[i].x - course.bodies[i].x).norm() < 1e-11);
    CHECK(exact.bodies[i].q.angularDistance(course.bodies[i].q) < 1e-11);
    CHECK((exact.bodies[i].omega - course.bodies[i].omega).norm() < 1e-11);
  }
  CHECK(exact.potential == Approx(course.potential).epsilon(1e-9));
  CHECK(exact.kinetic == Approx(course.kinetic).epsilon(1e-9));
}

// Oracle: √(2 h/g). Measured 0 s, allowed 1e-12 s.
TEST_CASE("the first touch is found, however the run is looked at") {
  WorldDef def = exactWorld(5.0);
  def.bodies = {ground(), ball("high", 0.1, {0.0, 3.1, 0.0}), ball("low", 0.1, {1.0, 2.1, 0.0})};
  const double t = std::sqrt(2.0 * 2.0 / 9.81);
  World world(def), other(def);
  run(world);
  other.advance(5.0);
  for (const World* w : {&world, &other}) {
    REQUIRE(w->report().events.size() == 4);  // each hits and stays
    const Event& first = w->report().events[0];
    CHECK(first.kind == EventKind::Impact);
    CHECK((first.a == 2 && first.b == 0));
    CHECK(std::abs(first.t - t) < 1e-12);
    CHECK(first.vrel == Approx(-9.81 * t));
    CHECK(first.j == Approx(9.81 * t));
    CHECK_FALSE(w->report().stopped);
    CHECK(w->report().certificate.energy_balance_error < 1e-12);
    CHECK(w->report().certificate.momentum_error < 1e-12);
  }
  CHECK(world.sample(5.0).bodies[1].x == other.sample(5.0).bodies[1].x);
}

// Oracle: m g, and no motion. Measured 0 m, 9e-16 N, allowed 1e-15, 1e-12.
TEST_CASE("a ball that lies on the floor stays, and is carried; one that is thrown up comes back") {
  WorldDef def = exactWorld(5.0);
  def.bodies = {ground(), ball("ball", 0.1, {0.0, 0.1, 0.0})};
  World lying(def);
  const Sample end = run(lying);
  CHECK(std::abs(end.bodies[1].x.y() - 0.1) < 1e-15);
  REQUIRE(end.contacts.size() == 1);
  CHECK((end.contacts[0].force - Vec3(0.0, 9.81, 0.0)).norm() < 1e-12);
  REQUIRE(lying.report().events.size() == 1);
  CHECK(lying.report().events[0].kind == EventKind::Rest);
  CHECK(lying.report().certificate.momentum_error < 1e-12);
  def.bodies[1].velocity = {0.0, 3.0, 0.0};
  World thrown(def);
  run(thrown);
  CHECK(std::abs(thrown.report().events.at(0).t - 6.0 / 9.81) < 1e-12);
  def.gravity.setZero();
  World gone(def);
  gone.advance(5.0);
  CHECK(gone.report().events.empty());
}

// Oracle: where a turning plank is when its side meets a ball that stands still: its tip runs along
// a circle. Measured 0 s, allowed 1e-12 s.
TEST_CASE("fixed bodies that move are flights too") {
  WorldDef def = exactWorld(5.0);
  def.gravity.setZero();
  BodyDef plank = box("plank", {2.0, 0.1, 0.1}, {0.0, 0.0, 0.0});
  plank.fixed = true;
  plank.angularVelocity = {0.0, 0.0, 0.5};
  def.bodies = {plank, ball("ball", 0.1, {0.0, 0.8, 0.0}, 1.0)};
  World world(def);
  world.advance(5.0);
  REQUIRE_FALSE(world.report().events.empty());
  // The ball's centre is 0.05 + 0.1 from the plank's axis when sin(angle between) = 0.15/0.8.
  const double exact = (0.5 * 3.14159265358979323846 - std::asin(0.15 / 0.8)) / 0.5;
  CHECK(std::abs(world.report().events[0].t - exact) < 1e-12);
  CHECK(world.sample(5.0).bodies[0].omega == Vec3(0.0, 0.0, 0.5));
  // What a moving body gives is work.
  CHECK(world.report().certificate.work_of_forces > 0.0);
  CHECK(world.report().certificate.energy_balance_error < 1e-12);
}

// Oracle: each pair alone. Windows and boxes must lose no pair and prefer no other.
// Measured 4.4e-16 s, allowed 1e-12 s.
TEST_CASE("among many bodies the first touch is the first of all pairs") {
  Random random(5);
  for (int scene = 0; scene < 4; ++scene) {
    WorldDef def = exactWorld(20.0);
    const int n = 120;
    for (int i = 0; i < n; ++i) {
      const Vec3 x = 40.0 * random.vector(-1.0, 1.0);
      const Vec3 v = random.vector(-1.0, 1.0) + Vec3(100.0, 0.0, 0.0);
      const Vec3 omega = random.vector(-10.0, 10.0);
      def.bodies.push_back(spinner("b" + std::to_string(i), x, v, omega));
    }
    const auto firstEvent = [](const WorldDef& scene) {
      World world(scene);
      world.advance(20.0);
      return world.report().events.empty() ? 21.0 : world.report().events[0].t;
    };
    double first = 21.0;
    for (int b = 0; b < n; ++b) {
      for (int a = b + 1; a < n; ++a) {
        WorldDef two = exactWorld(20.0);
        two.bodies = {def.bodies[b], def.bodies[a]};
        first = std::min(first, firstEvent(two));
      }
    }
    CAPTURE(scene, first);
    CHECK(std::abs(firstEvent(def) - first) < 1e-12);
  }
}

// Oracle: two methods. The course by Taylor series; measured 2e-15 m, 1e-14 rad, 5e-14 rad/s,
// allowed 1e-12, 1e-12, 1e-11.
TEST_CASE("a heavy top turns about its pivot, and stops where it meets something") {
  WorldDef def = exactWorld(2.0);
  def.bodies = {box("top", {0.2, 0.5, 0.1}, {0.0, 1.0, 0.0})};
  def.bodies[0].pivot_B = Vec3(0.0, 0.25, 0.0);
  def.bodies[0].orientation = fromAxisAngle({1.0, 0.0, 0.3}, 0.4);
  def.bodies[0].angularVelocity = {1.0, 6.0, 0.5};
  WorldDef steps = def;
  steps.method = "course";
  steps.course.integrator = "taylor";
  World exact(def), course(steps);
  CHECK(exact.sample(0.0).bodies[0].x == def.bodies[0].position);  // before any advance
  const Sample p = run(exact), q = run(course);
  CHECK_FALSE(exact.report().stopped);
  CHECK((p.bodies[0].x - q.bodies[0].x).norm() < 1e-12);
  CHECK(p.bodies[0].q.angularDistance(q.bodies[0].q) < 1e-12);
  CHECK((p.bodies[0].omega - q.bodies[0].omega).norm() < 1e-11);
  CHECK(exact.report().certificate.energy_balance_error < 1e-12);
  CHECK(exact.report().certificate.momentum_error < 1e-12);

  // A pendulum that is let go level meets a ball that hangs where it passes.
  def.bodies[0].orientation = fromAxisAngle({0.0, 0.0, 1.0}, 0.5 * 3.14159265358979323846);
  def.bodies[0].angularVelocity.setZero();
  const Vec3 pivot = def.bodies[0].position + def.bodies[0].orientation * *def.bodies[0].pivot_B;
  def.bodies.push_back(ball("ball", 0.05, pivot + Vec3(0.0, -0.4, 0.0)));
  def.bodies[1].fixed = true;
  World pendulum(def);
  pendulum.advance(2.0);
  REQUIRE(pendulum.report().stopped);
  const double t = stopTime(pendulum);
  for (int k = 0; k <= 200; ++k) {
    const BodySample top = pendulum.sample(t * k / 200).bodies[0];
    const double gap = separation(Box{{0.1, 0.25, 0.05}}, {top.x, top.q}, Sphere{0.05},
                                  {def.bodies[1].position, Quat::Identity()});
    CHECK((k < 200 ? gap > 0.0 : std::abs(gap) < 1e-12));
  }
  def.forces = {UniformWind{kNoBody, {1.0, 0.0, 0.0}}};
  CHECK_THROWS_AS(World(def), Refusal);
}

TEST_CASE("shapes without a contact rule fly apart from each other, and stop the run when near") {
  WorldDef def = exactWorld(5.0);
  def.gravity.setZero();
  def.bodies = {box("one", {0.4, 1.0, 0.4}, {0.0, 0.0, 0.0}),
                box("two", {0.4, 1.0, 0.4}, {2.0, 0.0, 0.0})};
  const auto mesh = std::make_shared<Polyhedron>(
      makePolyhedron({{-0.2, -0.5, -0.2}, {0.2, -0.5, -0.2}, {0.0, -0.5, 0.3}, {0.0, 0.5, 0.0}},
                     {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}}));
  for (BodyDef& body : def.bodies) body.shape = Mesh{mesh};
  World apart(def);
  apart.advance(5.0);
  CHECK_FALSE(apart.report().stopped);
  def.bodies[1].velocity = {-1.0, 0.0, 0.0};
  World meet(def);
  meet.advance(5.0);
  REQUIRE(meet.report().stopped);
  CHECK(meet.report().reason.find("\"two\" comes near \"one\" at t = 1.6") ==
        0);  // their boxes meet
}

TEST_CASE("what does not fly in closed form is refused, and what is not used is not listed") {
  const std::vector<Force> forces = {LinearDrag{0, 0.1, 0.0}, Spring{0, kNoBody},
                                     PointForce{0, {0.1, 0.0, 0.0}, {1.0, 0.0, 0.0}}};
  for (const Force& force : forces) {
    WorldDef def = exactWorld(1.0);
    def.bodies = {ball("ball", 0.1, {0.0, 1.0, 0.0})};
    def.forces = {UniformWind{}, force};
    try {
      World world(def);
      FAIL("not refused");
    } catch (const Refusal& refusal) {
      CHECK(refusal.where() == "forces[1]");
      CHECK(std::string(refusal.what()).find("\"course\"") != std::string::npos);
    }
  }
  WorldDef def = exactWorld(1.0);
  def.bodies = {ground(0.5, 0.5), ball("ball", 0.1, {0.0, 9.0, 0.0}, 0.5, 0.5)};
  CHECK(World(def).features() ==
        std::vector<std::string>{"gravity", "contact", "restitution", "friction"});
}
