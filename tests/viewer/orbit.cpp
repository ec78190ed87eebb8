// The viewer's camera.
#include "app/viewer/orbit.h"

#include "tests/catch.h"

using namespace tumble;

namespace {
const Camera kCamera = {.eye = {3.0, 2.5, 6.0}, .target = {0.5, 1.0, -0.5}, .fov = 30.0};
}

// Oracle: identity. Measured 2e-15 m, allowed 1e-12.
TEST_CASE("a camera survives the way into polar coordinates and back") {
  const Camera again = Orbit::of(kCamera).camera();
  CHECK((again.eye - kCamera.eye).norm() < 1e-12);
  CHECK((again.target - kCamera.target).norm() < 1e-12);
  CHECK(again.fov == kCamera.fov);
}

TEST_CASE("two images to the right are a full turn, and dragging down lifts the eye") {
  Orbit orbit = Orbit::of(kCamera);
  orbit.turn(2.0 * 720.0, 0.0, 720.0);
  CHECK((orbit.camera().eye - kCamera.eye).norm() < 1e-12);
  orbit.turn(0.0, 50.0, 720.0);
  CHECK(orbit.camera().eye.y() > kCamera.eye.y());
  CHECK((orbit.camera().eye - kCamera.target).norm() ==
        Approx((kCamera.eye - kCamera.target).norm()).epsilon(1e-12));
}

TEST_CASE("the eye never passes the poles") {
  Orbit orbit = Orbit::of(kCamera);
  orbit.turn(0.0, 1e6, 720.0);
  CHECK(orbit.elevation < 1.5708);
  CHECK((orbit.camera().eye - orbit.target).normalized().y() < 1.0);
}

TEST_CASE("a notch of the wheel brings the eye a tenth nearer") {
  Orbit orbit = Orbit::of(kCamera);
  const double before = orbit.distance;
  orbit.zoom(1.0);
  CHECK(orbit.distance == Approx(0.9 * before).epsilon(1e-12));
}

// Oracle: the image plane at the target's depth is 2 d tan(fov/2) high.
TEST_CASE("panning by the image's height shifts the target by the height of what is seen") {
  Orbit orbit = Orbit::of(kCamera);
  const Eigen::Vector3d before = orbit.target;
  orbit.pan(0.0, 720.0, 720.0);
  const double seen = 2.0 * orbit.distance * std::tan(15.0 * 3.14159265358979 / 180.0);
  CHECK((orbit.target - before).norm() == Approx(seen).epsilon(1e-12));
  CHECK((orbit.target - before).y() > 0.0);
  CHECK((orbit.target - before).dot(orbit.camera().eye - orbit.target) ==
        Approx(0.0).margin(1e-12));
}
