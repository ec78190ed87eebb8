// How deep solids are into each other, and the errors of runs made up by their closed form.
#include "tests/peers/overlap.h"

#include <cmath>
#include <numbers>

#include "tests/catch.h"
#include "tests/peers/measure.h"

using namespace tumble;
using namespace tumble::peers;

namespace {

const Trial& trial(const std::string& name) {
  for (const Trial& one : trials())
    if (one.name == name) return one;
  throw std::runtime_error("no trial " + name);
}

Scene sceneOf(const Trial& trial) {
  return readScene(std::string(TUMBLE_SOURCE_DIR "/tests/peers/scenes/") + trial.file + ".toml",
                   trial.overrides);
}

// The scene's bodies where they start.
std::vector<BodySample> start(const Scene& scene) {
  std::vector<BodySample> bodies;
  for (const BodyDef& body : scene.world.bodies)
    bodies.push_back({body.position, body.orientation, body.velocity, body.angularVelocity});
  return bodies;
}

}  // namespace

// Oracle: closed form; only rounding remains. A cube of edge 1 turned by 45° reaches √½ down.
TEST_CASE("overlaps of boxes, balls and planes are those of plane geometry") {
  const Box cube{Vec3::Constant(0.5)};
  const Quat turned(Eigen::AngleAxisd(std::numbers::pi / 4.0, Vec3::UnitZ())), straight(1, 0, 0, 0);
  const double reach = std::sqrt(0.5);
  struct Case {
    double depth, exact;
  };
  const Case found[] = {
      {overlap(cube, {{0.0, 0.9, 0.2}, straight}, cube, {}), 0.1},
      {overlap(cube, {{0.0, 1.2, 0.0}, turned}, cube, {}), reach - 0.7},
      {overlap(HalfSpace{}, {}, cube, {{3.0, 0.7, 0.0}, turned}), reach - 0.7},
      {overlap(Sphere{0.5}, {{0.8, 0.8, 0.0}, turned}, cube, {}), 0.5 - std::hypot(0.3, 0.3)},
      {overlap(Sphere{0.5}, {{0.0, 0.4, 0.0}, turned}, cube, {}), 0.6},
      {overlap(Sphere{0.5}, {}, Sphere{0.25}, {{0.0, 0.0, 0.7}, turned}), 0.05}};
  for (const Case& one : found) CHECK(std::abs(one.depth - one.exact) < 1e-15);
}

// Two crossed edges meet at √½ from either centre: no normal of a face parts them, their product
// does.
TEST_CASE("crossed edges are parted by their product alone") {
  const Box cube{Vec3::Constant(0.5)};
  const Pose low{Vec3::Zero(), Quat(Eigen::AngleAxisd(std::numbers::pi / 4.0, Vec3::UnitX()))};
  const Quat up(Eigen::AngleAxisd(std::numbers::pi / 4.0, Vec3::UnitZ()));
  const double meet = 2.0 * std::sqrt(0.5);
  CHECK(std::abs(overlap(cube, {{0.0, meet - 0.01, 0.0}, up}, cube, low) - 0.01) < 1e-15);
  CHECK(overlap(cube, {{0.0, meet + 0.01, 0.0}, up}, cube, low) < 0.0);
}

TEST_CASE("no scene begins with an overlap, or with two bodies of one name") {
  for (const Trial& one : trials()) {
    CAPTURE(one.name);
    const Scene scene = sceneOf(one);
    CHECK(deepestOverlap(scene.world, start(scene)) <= 1e-12);
    CHECK_NOTHROW(World(scene.world));
  }
}

// Oracle: closed form, sampled; the vertex of a parabola through three points is exact.
TEST_CASE("a ball that bounces as it should has no error, one that keeps too much has its excess") {
  const Trial& bounce = trial("bounce-0.8");
  const Scene scene = sceneOf(bounce);
  const auto motion = [&](double e) {
    Motion made{1.0 / 60.0, {}};
    double hit = std::sqrt(2.0 / 9.81), leave = -1.0, v = 1.0;
    for (int k = 0; k <= 300; ++k) {
      const double t = k / 60.0;
      for (; t >= hit && v > 0.1; hit += 2.0 * v / 9.81) {
        v = leave < 0.0 ? e * std::sqrt(2.0 * 9.81) : e * v;
        leave = hit;
      }
      const double s = t - leave;
      made.looks.push_back(start(scene));
      made.looks.back().back().x.y() =
          0.1 + (leave < 0.0 ? 1.0 - 0.5 * 9.81 * t * t : v * s - 0.5 * 9.81 * s * s);
    }
    return made;
  };
  CHECK(bounce.measure(scene, motion(0.8)) < 1e-13);
  CHECK(std::abs(bounce.measure(scene, motion(0.81)) - (0.81 * 0.81 - 0.64)) <= 5e-3);
}

TEST_CASE("what slides, stays, rolls or flies is held to its closed form") {
  const auto error = [](const std::string& name, const Vec3& way) {
    const Trial& one = trial(name);
    const Scene scene = sceneOf(one);
    Motion made{1.0, {start(scene), start(scene)}};
    made.looks.back().back().x += way;
    return one.measure(scene, made);
  };
  const double g = 9.81, slope = std::numbers::pi / 9.0;
  CHECK(error("slide", Vec3(4.0 / (2.0 * 0.5 * g), 0.0, 0.0)) < 1e-15);
  CHECK(error("slide45", Vec3(1.0, 0.0, 1.0).normalized() * 4.0 / g) < 1e-15);
  CHECK(error("slope", Vec3(2.0 * g * (std::sin(slope) - 0.2 * std::cos(slope)), 0.0, 0.0)) <
        1e-14);
  CHECK(std::abs(error("hold", Vec3(0.0, 0.0, 0.125)) - (0.125)) <= 1e-15);
  CHECK(error("roll", Vec3(5.0 / 14.0 * g * 0.5 * 4.0, 0.0, 0.0)) < 1e-14);
  CHECK(error("projectile", Vec3(6.0, 16.0 - 2.0 * g, 2.0)) < 1e-14);
  CHECK(std::abs(error("tower", Vec3(0.0, -0.25, 0.0)) - 0.25) <= 1e-15);
  CHECK(std::isinf(error("tower", Vec3(0.0, -0.35, 0.0))));
  CHECK(error("pile", Vec3(0.0, 0.0, 3.0)) == 0.0);
  CHECK(std::isinf(error("pile", Vec3(0.0, 0.0, 30.0))));
  CHECK(std::isinf(error("tray-balls", Vec3(0.0, -9.0, 0.0))));
}
