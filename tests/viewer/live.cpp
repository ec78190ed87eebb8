// The window's run that lives.
#include "app/viewer/live.h"

#include <cmath>
#include <numbers>

#include "app/record/recording.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

const std::string kThrown = R"([world]
duration = 1.0
[[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 2.0
position = [0, 1, 0]
velocity = [1, 3, 0]
)";

Sample startOf(const Scene& scene) {
  return makeWorld(scene).sample(0.0);
}

}  // namespace

// Oracle: parabolas. Measured: 1.8e-15 m.
TEST_CASE("what lives falls under the gravity that it is given, from where it was") {
  const Scene scene = parseScene(kThrown, "thrown");
  Live live(scene, 50.0);
  Sample sample = startOf(scene);
  for (int k = 0; k < 25; ++k) sample = *live.next(sample);
  WorldDef moon = live.settings();
  moon.gravity = {0.0, -1.62, 0.0};
  live.change(moon);
  for (int k = 0; k < 100; ++k) sample = *live.next(sample);
  CHECK(std::abs(sample.t - 2.5) < 1e-12);
  const double y = 1.0 + 3.0 * 0.5 - 0.5 * 9.81 * 0.25, v = 3.0 - 9.81 * 0.5;
  const Vec3 expected(2.5, y + v * 2.0 - 0.5 * 1.62 * 4.0, 0.0);
  CHECK((sample.bodies[0].x - expected).norm() < 1e-13);
}

// Oracle: x″ + 2 ζ ω x′ + ω² x = 0 with ω = 6π rad/s and ζ = 0.7. Measured: 2.5e-13 m.
TEST_CASE("a hand that stands pulls as its spring does, and lets go") {
  const Scene scene =
      parseScene(kThrown, "thrown", {"world.gravity=[0,0,0]", "body.ball.velocity=[0,0,0]"});
  Live live(scene, 60.0);
  Sample sample = startOf(scene);
  live.hold(Hand{0, Vec3::Zero(), {0.5, 1.0, 0.0}});
  for (int k = 0; k < 12; ++k) sample = *live.next(sample);
  const double omega = 6.0 * std::numbers::pi, zeta = 0.7, t = 0.2;
  const double damped = omega * std::sqrt(1.0 - zeta * zeta), decay = zeta * omega;
  const double left =
      -0.5 * std::exp(-decay * t) * (std::cos(damped * t) + decay / damped * std::sin(damped * t));
  CHECK(std::abs(sample.bodies[0].x.x() - (0.5 + left)) < 1e-11);
  const Vec3 v = sample.bodies[0].v;
  live.hold({});
  for (int k = 0; k < 60; ++k) sample = *live.next(sample);
  CHECK((sample.bodies[0].v - v).norm() < 1e-13);
}

// Oracle: a world that is refused says why, and what is shown stays.
TEST_CASE("settings that a world refuses leave their complaint, and others go on") {
  const Scene scene = parseScene(kThrown, "thrown");
  Live live(scene, 60.0);
  const Sample sample = startOf(scene);
  WorldDef def = live.settings();
  def.method = "stepping";
  def.stepping.step = -1.0;
  live.change(def);
  CHECK(!live.next(sample));
  CHECK(!live.complaint().empty());
  def.stepping.step = 0.01;
  live.change(def);
  CHECK(live.next(sample));
  CHECK(live.complaint().empty());
}

TEST_CASE("a hand leads a point of cloth to where it is, no faster than 3 m/s") {
  const Scene scene = parseScene(R"([world]
[[cloth]]
name = "cloth"
columns = 5
rows = 5
size = [0.4, 0.4]
thickness = 0.01
density = 0.2
stretch = 100.0
shear = 10.0
bend = 1e-5
pins = "corners"
position = [0, 1, 0]
)",
                                 "cloth");
  Live live(scene, 60.0);
  Sample sample = startOf(scene);
  const int middle = 12;
  const Vec3 x = sample.bodies[middle].x, target = x + Vec3(0.0, 0.08, 0.0);
  live.hold(Hand{middle, Vec3::Zero(), target});
  sample = *live.next(sample);
  CHECK(std::abs((sample.bodies[middle].x - x).norm() - 0.05) < 1e-15);
  sample = *live.next(sample);
  CHECK((sample.bodies[middle].x - target).norm() < 1e-15);
  sample = *live.next(sample);
  CHECK((sample.bodies[middle].x - target).norm() < 1e-15);
  live.hold({});
  for (int k = 0; k < 30; ++k) sample = *live.next(sample);
  CHECK(sample.bodies[middle].x.y() < x.y());
}
