// The claims of what stands, falls and comes to rest: the cone that decides, true runs, untrue
// ones.
#include <algorithm>
#include <cmath>

#include "app/claim/equilibrium.h"
#include "tests/app/claims.h"
#include "tests/app/runs.h"

using namespace tumble;

namespace {

// A block of 1 kg, 0.2 m wide and 0.4 m high, on a slope of these degrees.
Scene blockOn(double degrees, double mu) {
  const double a = degrees * EIGEN_PI / 180.0;
  char text[900];
  std::snprintf(text, sizeof text, R"(
[world]
method = "stepping"
duration = 1.0
[[body]]
name = "slope"
shape = { plane = [%.17g, %.17g, 0.0, 0.0] }
friction = %.17g
[[body]]
name = "block"
shape = { box = [0.2, 0.4, 0.3] }
mass = 1.0
friction = %.17g
position = [%.17g, %.17g, 0.0]
orientation = { axis = [0, 0, 1], degrees = %.17g }
)",
                std::sin(a), std::cos(a), mu, mu, 0.2 * std::sin(a), 0.2 * std::cos(a), -degrees);
  return parseScene(text, "block.toml");
}

// Eleven stones between half-circles of 1 m ∓ t/2, on a floor.
Scene archOf(double t) {
  std::string text = R"(
[world]
method = "stepping"
duration = 0.1
[materials.stone]
density = 2400.0
friction = 0.8
[[body]]
name = "floor"
shape = { plane = [0.0, 1.0, 0.0, 0.0] }
material = "stone"
)";
  const double inner = 1.0 - 0.5 * t, outer = 1.0 + 0.5 * t, half = EIGEN_PI / 22.0;
  const double centre =  // of a trapezoid between parallel sides 2 r sin half
      std::cos(half) * (inner + (outer - inner) / 3.0 * (inner + 2.0 * outer) / (inner + outer));
  for (int k = 0; k < 11; ++k) {
    std::string hull;
    char part[160];
    for (const double z : {-0.15, 0.15})
      for (const double r : {inner, outer})
        for (const int joint : {k, k + 1}) {
          const double angle = 2.0 * half * joint;
          std::snprintf(part, sizeof part, "[%.17g, %.17g, %g], ", r * std::cos(angle),
                        r * std::sin(angle) * (joint % 11 != 0), z);
          hull += part;
        }
    const double angle = half * (2 * k + 1);
    std::snprintf(part, sizeof part, "position = [%.17g, %.17g, 0.0]\n", centre * std::cos(angle),
                  centre * std::sin(angle));
    text += "[[body]]\nname = \"stone" + std::to_string(k) +
            "\"\nmaterial = \"stone\"\nshape = { hull = [" + hull + "] }\n" + part;
  }
  return parseScene(text, "arch.toml");
}

// What statics says of all bodies together, whatever they do then.
std::string verdictOn(const Scene& scene) {
  const std::vector<ClaimRow> rows = findCheck("equilibrium")->rows(scene, record(scene, 60.0));
  return rows.size() == 1 ? rows[0].label : "";
}

bool saysRow(const Scene& scene, const char* words) {
  const std::vector<ClaimRow> rows =
      findCheck("equilibrium")->rows(scene, record(scene, scene.image.rate));
  return std::any_of(rows.begin(), rows.end(), [&](const ClaimRow& row) {
    return row.holds() && row.label.find(words) != std::string::npos;
  });
}

}  // namespace

// Oracle: closed forms in the plane. Measured 1e-16, allowed 1e-14.
TEST_CASE("the distance of a load from a cone is that of plane geometry") {
  MatX cone(2, 2);
  cone << 1.0, 0.0, 0.0, 1.0;
  const auto distance = [&](double x, double y) {
    return coneDistance(cone, VecX(Vec3(x, y, 0).head<2>()));
  };
  CHECK(distance(3.0, 4.0) < 1e-14);
  CHECK(std::abs(distance(3.0, -4.0) - 0.8) < 1e-14);
  CHECK(std::abs(distance(-3.0, -4.0) - 1.0) < 1e-14);
  cone << 1.0, 1.0, 1.0, 1.0;  // twice the same
  CHECK(std::abs(distance(0.0, 1.0) - std::sqrt(0.5)) < 1e-14);
}

// Oracles: tan θ = μ, and tan θ = 0.2/0.4, above which a block topples.
TEST_CASE("a block on a slope is held below the angle of friction and below that of toppling") {
  CHECK(saysRow(blockOn(20.0, 0.37), "can be held"));
  CHECK(saysRow(blockOn(20.0, 0.36), "cannot be held"));
  CHECK(saysRow(blockOn(26.5, 2.0), "can be held"));
  CHECK(saysRow(blockOn(26.6, 2.0), "cannot be held"));
}

// Oracle: the line of thrust, as a linear programme in the push at the crown and its height, fits
// in a half-circle of eleven stones from t/R = 0.104589146 on.
TEST_CASE("an arch of eleven stones can be held from a thickness of 0.104589 radii on") {
  CHECK(verdictOn(archOf(0.104588)) == "stone0: cannot be held, and falls");
  CHECK(verdictOn(archOf(0.104590)) == "stone0: can be held, and moves by / radii");
}

// Oracle: the same limit.
TEST_CASE("an arch falls by what statics says, not by what it is named") {
  const Scene scene = demo("arch");
  const Recording right = record(scene, 20.0);
  CHECK(saysRow(scene, "thick_0: can be held"));
  CHECK(saysRow(scene, "thin_0: cannot be held"));
  CHECK(holds("settled", scene, right));
  const auto bodyNamed = [&](const char* name) {
    int body = 0;
    while (scene.world.bodies[body].name != name) ++body;
    return body;
  };
  CHECK_FALSE(holdsBroken("equilibrium", scene, right, [&](Recording& r) {
    r.samples[40].bodies[bodyNamed("thick_4")].x.y() -= 1e-8;
  }));
  CHECK_FALSE(holdsBroken("equilibrium", scene, right,
                          [](Recording& r) { r.samples.resize(5); }));  // has not fallen yet
  CHECK_FALSE(holdsBroken("settled", scene, right, [](Recording& r) {
    for (ContactSample& c : r.samples.back().contacts) c.force *= 1.0 + 1e-8;
  }));
  CHECK_FALSE(holdsBroken("settled", scene, right, [&](Recording& r) {
    r.samples.back().bodies[bodyNamed("thin_3")].omega.z() += 1e-5;
  }));
  CHECK_FALSE(holdsBroken("settled", scene, right,
                          [](Recording& r) { r.samples.back().contacts[0].separation = -1e-8; }));
}

// Oracle: the ball, which touches the post for no time, 0.07 s from the start.
TEST_CASE("what stands is held to it until something strikes it") {
  Scene scene = parseScene(R"(
[world]
method = "stepping"
duration = 0.5
[materials.m]
density = 1000.0
restitution = 0.8
friction = 0.5
[[body]]
name = "floor"
shape = { plane = [0.0, 1.0, 0.0, 0.0] }
material = "m"
[[body]]
name = "post"
shape = { box = [0.2, 1.0, 0.2] }
position = [0.0, 0.5, 0.0]
material = "m"
[[body]]
name = "ball"
shape = { sphere = 0.1 }
position = [-0.9, 0.8, 0.0]
velocity = [10.0, 0.0, 0.0]
material = "m"
)",
                           "post.toml");
  const Recording right = record(scene, 20.0);
  CHECK((right.samples.back().bodies[1].x - right.samples.front().bodies[1].x).norm() > 0.01);
  CHECK(holds("equilibrium", scene, right));
  CHECK_FALSE(holdsBroken("equilibrium", scene, right,
                          [](Recording& r) { r.samples[1].bodies[1].x.y() += 1e-8; }));
}

// Oracle: the tampering.
TEST_CASE("the claim of the end names the body that moves and the pair that overlaps") {
  const Scene scene = blockOn(0.0, 0.5);
  Recording recording = record(scene, 20.0);
  recording.samples.back().bodies[1].v.x() = 0.1;
  recording.samples.back().contacts[0].separation = -1e-3;
  const std::vector<ClaimRow> rows = findCheck("settled")->rows(scene, recording);
  REQUIRE(rows.size() == 3);
  CHECK(rows[1].label == scene.world.bodies[1].name + ": fastest point at the end / (m/s)");
  CHECK(rows[2].label == scene.world.bodies[1].name + " on " + scene.world.bodies[0].name +
                             ": deepest overlap at the end / m");
}

// Oracle: statics. A bar of 3 kg, pinned to the world at one end, lies on a prop at the other.
TEST_CASE("what a joint with the world carries counts as carried") {
  const Scene scene = parseScene(R"(
[world]
method = "stepping"
duration = 1.0
[[body]]
name = "prop"
shape = { box = [0.1, 1.0, 0.3] }
position = [0.9, 0.5, 0.0]
fixed = true
[[body]]
name = "bar"
shape = { box = [1.0, 0.1, 0.3] }
mass = 3.0
position = [0.5, 1.05, 0.0]
[[joint]]
kind = "hinge"
a = "bar"
anchor = [0.0, 1.05, 0.0]
axis = [0.0, 0.0, 1.0]
)",
                                 "bar.toml");
  const Recording right = record(scene, 20.0);
  CHECK(holds("settled", scene, right));
  CHECK_FALSE(holdsBroken("settled", scene, right,
                          [](Recording& r) { r.samples.back().joints[0].force *= 1.0 + 1e-8; }));
}

TEST_CASE("where nothing rests or weighs anything, the claims say so") {
  const Scene scene = demo("cradle");
  const Recording recording = record(scene, 10.0);
  CHECK_FALSE(holds("equilibrium", scene, recording));
  CHECK_FALSE(holds("settled", scene, recording));
}
