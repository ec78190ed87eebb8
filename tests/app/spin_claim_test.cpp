// The claims of free rotation accept runs that are true and refuse each kind of untruth.
#include <cmath>
#include <functional>

#include "sim/math/rotation.h"
#include "tests/app/claims.h"

using namespace tumble;

namespace {

// A brick that spins almost about its middle axis, and flips every 4 s or so.
Scene brickScene(const char* method, double wobble = 1e-3) {
  BodyDef brick;
  brick.name = "brick";
  brick.shape = Box{{0.05, 0.1, 0.15}};
  brick.density = 1000.0;
  brick.orientation = fromAxisAngle({1.0, 2.0, -0.5}, 0.8);
  brick.angularVelocity = brick.orientation * Vec3(wobble, 10.0, 0.0);
  Scene scene;
  scene.world.method = method;
  scene.world.duration = 10.0;
  scene.world.bodies = {brick};
  scene.world.gravity.setZero();
  return scene;
}

}  // namespace

// Oracles: those of the claims. Exact flight, measured: 1.6e-14 rad from sample to sample, energy
// and |L| 2.9e-15, flips 3.5e-11 of a half period. RK4 at 1/960 s: 2.6e-4 rad, 5.3e-11, 1.3e-5.
TEST_CASE("a run in closed form and one by fine steps keep the claims of free rotation") {
  for (const char* method : {"exact", "course"}) {
    CAPTURE(method);
    Scene scene = brickScene(method);
    scene.world.course.step = 1.0 / 960.0;
    const Recording recording = record(scene, 60.0);
    CHECK(holds("free-spin", scene, recording));
    CHECK(holds("flips", scene, recording));
  }
}

TEST_CASE("the claims hold for other wobbles, spins about an outer axis, and balls") {
  for (const double wobble : {0.3, -1e-2, 1e-6}) {
    CAPTURE(wobble);
    const Scene scene = brickScene("exact", wobble);
    const Recording recording = record(scene, 60.0);
    CHECK(holds("free-spin", scene, recording));
    CHECK(holds("flips", scene, recording));
  }
  Scene scene = brickScene("exact");
  scene.world.bodies[0].angularVelocity = {3.0, 0.0, 9.0};
  scene.world.bodies.push_back(scene.world.bodies[0]);
  scene.world.bodies[1].name = "ball";
  scene.world.bodies[1].shape = Sphere{0.1};
  scene.world.bodies[1].position = {1.0, 0.0, 0.0};
  CHECK(holds("free-spin", scene, record(scene, 60.0)));
}

TEST_CASE("the claims refuse another attitude, spin, energy, and flips that come late or not") {
  const Scene scene = brickScene("exact");
  const Recording truth = record(scene, 60.0);
  const auto spin = [&](const std::function<void(Recording&)>& breakIt) {
    return holdsBroken("free-spin", scene, truth, breakIt);
  };
  CHECK(spin([](Recording&) {}));
  CHECK_FALSE(spin([](Recording& r) {
    Quat& q = r.samples[300].bodies[0].q;
    q = rotated(q, {0.0, 1e-8, 0.0});
  }));
  CHECK_FALSE(spin([](Recording& r) { r.samples[300].bodies[0].omega *= 1.0 + 1e-10; }));
  CHECK_FALSE(spin([](Recording& r) { r.samples[300].bodies[0].omega.x() = std::nan(""); }));
  CHECK_FALSE(spin([](Recording& r) { r.samples.clear(); }));
  const auto flips = [&](const std::function<void(Recording&)>& breakIt) {
    return holdsBroken("flips", scene, truth, breakIt);
  };
  CHECK(flips([](Recording&) {}));
  CHECK_FALSE(flips([](Recording& r) {
    for (Sample& sample : r.samples) sample.t *= 1.0 + 1e-8;
  }));
  CHECK_FALSE(flips([](Recording& r) { r.samples.resize(r.samples.size() / 2, {}); }));
  CHECK_FALSE(flips([](Recording& r) {
    for (Sample& sample : r.samples) sample.bodies[0] = r.samples[0].bodies[0];
  }));
  // The same motion is none of a brick with another wobble.
  CHECK_FALSE(holds("flips", brickScene("exact", 1.0001e-3), truth));
  Scene lighter = scene;
  lighter.world.bodies[0].inertia = Vec3(1.0, 0.8, 0.4);
  CHECK_FALSE(holds("free-spin", lighter, truth));
}

// A coarse integrator must fail where a fine one passes.
TEST_CASE("the claim of attitude tells Euler's rule from the truth") {
  Scene scene = brickScene("course");
  scene.world.course.integrator = "euler";
  CHECK_FALSE(holds("free-spin", scene, record(scene, 60.0)));
}

// A spin exactly about the middle axis never turns over, nor does a symmetric body.
TEST_CASE("the claim of flips ends at once where nothing turns over") {
  Scene scene = brickScene("exact", 0.0);
  scene.world.bodies[0].orientation = Quat::Identity();
  scene.world.bodies[0].angularVelocity = {0.0, 10.0, 0.0};
  CHECK_FALSE(holds("flips", scene, record(scene, 60.0)));
  scene.world.bodies[0].shape = Box{{0.05, 0.05, 0.15}};
  scene.world.bodies[0].angularVelocity = {1.0, 10.0, 0.0};
  CHECK_FALSE(holds("flips", scene, record(scene, 60.0)));
  CHECK(holds("free-spin", scene, record(scene, 60.0)));
}

// Measured at one sample a second: flips 3e-13 of a half period, attitude 1.2e-12 rad. The needle,
// 100 times as long as thick, turns by 14 rad between samples.
TEST_CASE("the claims of free rotation hold however far apart the samples are") {
  Scene scene = brickScene("exact", 1.0);
  const Recording coarse = record(scene, 1.0);
  CHECK(holds("free-spin", scene, coarse));
  CHECK(holds("flips", scene, coarse));
  Scene needle = brickScene("exact");
  needle.world.bodies[0].shape = Box{{0.5, 0.005, 0.005}};
  needle.world.bodies[0].angularVelocity =
      needle.world.bodies[0].orientation * Vec3(30.0, 1.0, 0.0);
  CHECK(holds("free-spin", needle, record(needle, 2.0)));
}
