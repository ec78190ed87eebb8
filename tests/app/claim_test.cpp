// Claims accept recordings that are true and refuse each kind of untruth.
#include <cmath>
#include <functional>

#include "app/claim/fall.h"
#include "app/claim/free_body.h"
#include "app/claim/verdict.h"
#include "tests/app/claims.h"

using namespace tumble;

namespace {

BodyDef floorBody() {
  BodyDef floor;
  floor.name = "floor";
  floor.shape = HalfSpace{};
  floor.fixed = true;
  return floor;
}

// A ball of 2 kg over a floor.
Scene ballScene(double e, double clearance) {
  BodyDef ball;
  ball.name = "ball";
  ball.shape = Sphere{0.1};
  ball.mass = 2.0;
  ball.restitution = e;
  ball.position = {0.0, clearance + 0.1, 0.0};
  Scene scene;
  scene.world.duration = 3.0;
  scene.world.bodies = {floorBody(), ball};
  return scene;
}

// The true bouncing of the ball, from textbook arcs alone: no code of the claims is used.
Recording bouncing(const Scene& scene, double e, double h, double g) {
  Recording recording;
  recording.rate = 60.0;
  double begin = 0.0, y = h, v = 0.0, end = std::sqrt(2.0 * h / g);
  const double rest = end * (1.0 + e) / (1.0 - e);
  for (int k = 0; k <= 180; ++k) {
    const double t = k / 60.0;
    while (t >= end && end - begin > 1e-7) {
      const double hit = v - g * (end - begin);
      recording.report.events.push_back({end,
                                         EventKind::Impact,
                                         1,
                                         0,
                                         {0.0, 0.0, 0.0},
                                         Vec3::UnitY(),
                                         hit,
                                         -2.0 * (1.0 + e) * hit});
      begin = end;
      y = 0.0;
      v = -e * hit;
      end = begin + 2.0 * v / g;
    }
    const double s = t - begin;
    const bool resting = t >= rest;
    Sample sample{t, {BodySample{}, BodySample{}}, {}, 0.0, 0.0};
    sample.bodies[1].x = {0.0, 0.1 + (resting ? 0.0 : y + v * s - 0.5 * g * s * s), 0.0};
    sample.bodies[1].v = {0.0, resting ? 0.0 : v - g * s, 0.0};
    sample.kinetic = sample.bodies[1].v.squaredNorm();
    recording.samples.push_back(sample);
  }
  if (rest < scene.world.duration)
    recording.report.events.push_back(
        {rest, EventKind::Rest, 1, 0, Vec3::Zero(), Vec3::UnitY(), 0.0, 0.0});
  return recording;
}

}  // namespace

// Oracle: closed form, written down here a second time.
TEST_CASE("a true bouncing ball keeps the claims of apex, rest, first hit and arcs") {
  const Scene scene = ballScene(0.5, 2.0);
  const Recording recording = bouncing(scene, 0.5, 2.0, 9.81);
  CHECK(holds("bounce-apex", scene, recording));
  CHECK(holds("rest-time", scene, recording));
  CHECK(holds("first-hit", scene, recording));
  CHECK(holds("arcs", scene, recording));
}

// Oracle: the scene. A ball that is in the air to the end tells nothing of rest, one that lies
// from the start nothing of a first hit.
TEST_CASE("claims of rest and of a first hit fail where they say nothing") {
  Scene flying = ballScene(0.5, 2.0);
  flying.world.duration = 0.6;  // it would hit at 0.639 s
  CHECK_FALSE(holds("rest-time", flying, record(flying, 60.0)));
  const Scene lying = ballScene(0.5, 0.0);
  CHECK_FALSE(holds("first-hit", lying, record(lying, 60.0)));
  flying.checks = {"rest-time"};
  const Verdict verdict = judge(flying, record(flying, 60.0));
  CHECK(verdict.failed == 1);
  CHECK(toldOf(verdict) == "its claim fails");
  CHECK(verdict.worst ==
        "rest-time says nothing here: no body falls onto a floor without spin "
        "before the end");
}

// Oracle: free fall. A ball let go at rest, which does not spin, has nothing to be off by.
TEST_CASE("the arcs of a ball that falls straight and stays down hold") {
  const Scene dull = ballScene(0.0, 0.2);
  CHECK(holds("arcs", dull, record(dull, 60.0)));
}

TEST_CASE("the apex claim refuses a wrong impulse, a lost hit and a motion with other speeds") {
  const Scene scene = ballScene(0.5, 2.0);
  const Recording truth = bouncing(scene, 0.5, 2.0, 9.81);
  CHECK_FALSE(holdsBroken("bounce-apex", scene, truth,
                          [](Recording& r) { r.report.events[2].j *= 1.0 + 1e-6; }));
  CHECK_FALSE(holdsBroken("bounce-apex", scene, truth,
                          [](Recording& r) { r.report.events.erase(r.report.events.begin()); }));
  CHECK_FALSE(holdsBroken("bounce-apex", scene, truth,
                          [](Recording& r) { r.samples[70].bodies[1].v *= 1.0 + 3e-6; }));
  CHECK_FALSE(holdsBroken("bounce-apex", scene, truth,
                          [](Recording& r) { r.samples[50].bodies[1].x.y() += 3e-6; }));
  CHECK_FALSE(holdsBroken("bounce-apex", scene, truth,
                          [](Recording& r) { r.samples[60].bodies[1].v.y() = std::nan(""); }));
  // The same motion is none of a scene with another restitution, gravity or height.
  CHECK_FALSE(holds("bounce-apex", ballScene(0.500001, 2.0), truth));
  CHECK_FALSE(holds("bounce-apex", ballScene(0.5, 2.00001), truth));
  Scene moon = scene;
  moon.world.gravity.y() = -9.8101;
  CHECK_FALSE(holds("bounce-apex", moon, truth));
}

TEST_CASE("the rest claim refuses rest that is late, missing, or taken back by another hit") {
  const Scene scene = ballScene(0.5, 2.0);
  const Recording truth = bouncing(scene, 0.5, 2.0, 9.81);
  CHECK_FALSE(holdsBroken("rest-time", scene, truth,
                          [](Recording& r) { r.report.events.back().t += 0.0011; }));
  CHECK_FALSE(
      holdsBroken("rest-time", scene, truth, [](Recording& r) { r.report.events.pop_back(); }));
  CHECK_FALSE(holdsBroken("rest-time", scene, truth, [](Recording& r) {
    Event again = r.report.events.front();
    again.t = 2.5;
    r.report.events.push_back(again);
  }));
  // A ball that is still bouncing at the end must not have come to rest.
  const Scene lively = ballScene(0.9, 2.0);
  const Recording bounces = bouncing(lively, 0.9, 2.0, 9.81);
  CHECK(holds("rest-time", lively, bounces));
  CHECK_FALSE(holdsBroken("rest-time", lively, bounces, [&](Recording& r) {
    r.report.events.push_back(truth.report.events.back());
  }));
}

TEST_CASE("the claim of the first hit refuses an earlier, a later and no hit") {
  const Scene scene = ballScene(0.5, 2.0);
  const Recording truth = bouncing(scene, 0.5, 2.0, 9.81);
  for (const double shift : {-1.1e-6, 1.1e-6})
    CHECK_FALSE(holdsBroken("first-hit", scene, truth,
                            [&](Recording& r) { r.report.events[0].t += shift; }));
  CHECK_FALSE(
      holdsBroken("first-hit", scene, truth, [](Recording& r) { r.report.events.clear(); }));
}

TEST_CASE("the claim of arcs refuses a bent arc, a wrong impulse, gained energy and made-up spin") {
  const Scene scene = ballScene(0.5, 2.0);
  const Recording truth = bouncing(scene, 0.5, 2.0, 9.81);
  const auto broken = [&](const std::function<void(Recording&)>& breakIt) {
    return holdsBroken("arcs", scene, truth, breakIt);
  };
  CHECK_FALSE(broken([](Recording& r) { r.samples[20].bodies[1].x.x() += 2e-9; }));
  CHECK_FALSE(broken([](Recording& r) { r.report.events[0].j *= 1.0 + 1e-8; }));
  CHECK_FALSE(broken([](Recording& r) { r.report.events[0].n *= -1.0; }));
  CHECK_FALSE(broken([](Recording& r) { r.report.events[0].vrel *= -1.0; }));
  CHECK_FALSE(broken([](Recording& r) { r.report.events[0].p.x() += 1e-5; }));
  CHECK_FALSE(broken([](Recording& r) { r.samples[20].bodies[1].omega.z() = 1e-3; }));
  CHECK_FALSE(broken([](Recording& r) { r.report.events.clear(); }));
}

// Oracle: statics, 9.81 N/kg.
TEST_CASE("the tower claim wants the weight above from below, and neither drift nor overlap") {
  Scene scene;
  BodyDef box;
  box.shape = Box{Vec3::Constant(0.25)};
  box.mass = 1.0;
  scene.world.bodies = {floorBody(), box, box};
  for (int i : {1, 2}) {
    scene.world.bodies[i].name = i == 1 ? "low" : "high";
    scene.world.bodies[i].position = {0.0, 0.5 * i - 0.25, 0.0};
  }
  Recording truth;
  Sample sample{0.0, {BodySample{}, BodySample{}, BodySample{}}, {}, 0.0, 0.0};
  for (int i : {1, 2}) sample.bodies[i].x = scene.world.bodies[i].position;
  for (const double side : {-0.25, 0.25}) {
    sample.contacts.push_back({1, 0, {side, 0.0, 0.0}, Vec3::UnitY(), 0.0, {0.0, 9.81, 0.0}});
    sample.contacts.push_back({2, 1, {side, 0.5, 0.0}, Vec3::UnitY(), 0.0, {0.0, 0.5 * 9.81, 0.0}});
  }
  truth.samples = {sample, sample};
  CHECK(holds("tower-forces", scene, truth));

  const auto broken = [&](const std::function<void(Sample&)>& breakIt) {
    return holdsBroken("tower-forces", scene, truth, [&](Recording& r) { breakIt(r.samples[1]); });
  };
  CHECK_FALSE(broken([](Sample& s) { s.contacts[0].force *= 1.0 + 3e-6; }));
  CHECK_FALSE(broken([](Sample& s) { s.contacts[1].force *= -1.0; }));
  CHECK_FALSE(broken([](Sample& s) { s.contacts[1].force.x() = 2e-5; }));
  CHECK_FALSE(broken([](Sample& s) { s.bodies[2].x.z() += 1.1e-3; }));
  CHECK_FALSE(broken([](Sample& s) { s.contacts[2].separation = -1.1e-4; }));
  CHECK_FALSE(broken([](Sample& s) { s.contacts.clear(); }));
  Scene heavy = scene;
  heavy.world.bodies[2].mass = 1.00001;
  CHECK_FALSE(holds("tower-forces", heavy, truth));
}

TEST_CASE("a claim that finds nothing to hold fails") {
  const Scene scene = ballScene(0.5, 2.0);
  for (const Check& check : checks()) {
    INFO(check.name);
    CHECK_FALSE(holds(check.name.data(), scene, Recording{}));
  }
  // A ball at rest on the floor does not fall.
  Scene resting = ballScene(0.5, 0.0);
  CHECK_FALSE(holds("bounce-apex", resting, Recording{}));
}

// Oracle: symmetry. A fall along a tilted normal is the upright one, turned.
TEST_CASE("a fall is told along the floor's normal, whatever way that stands") {
  const Quat q = Quat(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -0.5).normalized()));
  Scene upright = ballScene(0.6, 1.5);
  upright.world.bodies[1].velocity = {0.3, 1.0, -0.2};
  Scene tilted = upright;
  tilted.world.gravity = q * upright.world.gravity;
  std::get<HalfSpace>(tilted.world.bodies[0].shape).n = q * Vec3::UnitY();
  tilted.world.bodies[1].position = q * upright.world.bodies[1].position;
  tilted.world.bodies[1].velocity = q * upright.world.bodies[1].velocity;
  const Fall a = fallsOf(upright).at(0), b = fallsOf(tilted).at(0);
  // Rounding only: measured 4e-16, allowed 1e-13.
  CHECK(a.firstHit() == Approx(b.firstHit()).epsilon(1e-13));
  CHECK(a.restTime() == Approx(b.restTime()).epsilon(1e-13));
  CHECK(a.heightAt(1.0) == Approx(b.heightAt(1.0)).epsilon(1e-13));
  CHECK((q * a.glide - b.glide).norm() < 1e-13);
  // Thrown upward at 1 m/s: y = 1.5 + t − 4.905 t² = 0.
  CHECK(a.firstHit() == Approx((1.0 + std::sqrt(1.0 + 4.0 * 4.905 * 1.5)) / 9.81).epsilon(1e-14));
}

TEST_CASE("mass, free acceleration and reach are read from the scene") {
  WorldDef world;
  BodyDef box;
  box.shape = Box{{0.2, 0.05, 0.15}};
  box.density = 1900.0;
  world.bodies = {box};
  CHECK(massOf(box).mass == Approx(22.8).epsilon(1e-14));  // 0.4 · 0.1 · 0.3 · 1900
  world.forces = {UniformWind{kNoBody, {18.24, 0.0, 0.0}}};
  CHECK((*freeAcceleration(world, 0) - Vec3(0.8, -9.81, 0.0)).norm() < 1e-14);
  world.forces.push_back(LinearDrag{0, 0.1, 0.0});
  CHECK_FALSE(freeAcceleration(world, 0).has_value());
  // A box turned by 30° about z reaches 0.2 sin 30° + 0.05 cos 30° down.
  const Quat q(Eigen::AngleAxisd(EIGEN_PI / 6.0, Vec3::UnitZ()));
  CHECK(reach(box.shape, q, Vec3(-Vec3::UnitY())) ==
        Approx(0.1 + 0.05 * std::sqrt(0.75)).epsilon(1e-14));
  CHECK(reach(Cylinder{0.1, 0.6}, q, Vec3::UnitY()) ==
        Approx(0.3 * std::sqrt(0.75) + 0.05).epsilon(1e-14));
}
