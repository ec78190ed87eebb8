// Chains of light links that swing a heavy end mass: what joints pull at turns far faster than a
// step.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/catch.h"
#include "tests/world/joints.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

constexpr double kLevel = 0.5 * std::numbers::pi;

}  // namespace

// Oracle: conservation. The links swing faster than the step can follow, so that it is divided;
// without that they fly apart within a second. Measured: the energy strays by 2.7e-3 of the load
// times the length at most; allowed 6e-3. The end stays within its length.
TEST_CASE("stepping: a chain with a load of up to a million links swings and stays whole",
          "[figures]") {
  const int links = GENERATE(2, 3, 8);
  const double ratio = GENERATE(10.0, 1e3, 1e6);
  World world(chainOf("stepping", links, ratio, kLevel));
  const double scale = ratio * 9.81 * links * kLink;
  double farthest = 0.0, energy = 0.0;
  for (int k = 1; k <= 40 && !world.report().stopped; ++k) {
    world.advance(0.05 * k);
    const Sample sample = world.sample(0.05 * k);
    farthest = std::max(farthest, sample.bodies.back().x.norm() / (links * kLink));
    energy = std::max(energy, std::abs(sample.kinetic + sample.potential) / scale);
  }
  const Report& report = world.report();
  WARN("chain of " << links << ", end " << ratio << " : 1: joint gap "
                   << report.certificate.max_joint_gap << " m, energy " << energy);
  CAPTURE(links, ratio, report.reason, farthest, energy);
  CHECK_FALSE(report.stopped);
  CHECK(farthest < 1.0 + 1e-9);
  CHECK(energy < 6e-3);
  CHECK(report.certificate.max_joint_gap < 1e-9);
}

// Oracle: two methods agree. The end falls 0.6 m; after 0.45 s at 240 steps a second it is
// 6.5e-6 m beside the exact one, allowed 2e-5.
TEST_CASE("stepping: a heavy chain swings as in the exact method") {
  World steps(chainOf("stepping", 3, 1e3, kLevel)), exact(chainOf("exact", 3, 1e3, kLevel));
  steps.advance(0.45);
  exact.advance(0.45);
  const double off =
      (steps.sample(0.45).bodies.back().x - exact.sample(0.45).bodies.back().x).norm();
  CAPTURE(off);
  CHECK(off < 2e-5);
}

// Oracle: statics, g m on each pin of all that hangs below it. Nothing moves, to the bit, and a
// step costs one look at the forces. Measured: forces off by 2e-10 of the load, allowed 1e-9.
TEST_CASE("exact: a chain that hangs at rest stays there under any load, for nothing") {
  const double ratio = GENERATE(1.0, 1e5, 1e6);
  World world(chainOf("exact", 8, ratio, 0.0));
  world.advance(2.0);
  const Sample start = world.sample(1.99 - 1e-3), end = world.sample(2.0);
  double off = 0.0;
  for (std::size_t k = 0; k < end.joints.size(); ++k)
    off = std::max(off, std::abs(end.joints[k].force.norm() / 9.81 - (7.0 - k + ratio)));
  CAPTURE(ratio, off / ratio, world.report().certificate.evaluations);
  for (const Sample* sample : {&start, &end})
    for (std::size_t k = 0; k < sample->bodies.size(); ++k)
      CHECK(sample->bodies[k].x == Vec3(0.0, world.model().def.bodies[k].position.y(), 0.0));
  CHECK(off < 1e-9 * ratio);
  CHECK(world.report().certificate.evaluations <= 2 * world.report().certificate.steps);
}

// Oracle: conservation. Fixed steps cannot follow the links; the run ends where a joint has come
// apart, before that shows in energies: measured 5e-6 of the load times the length, allowed 1e-3.
TEST_CASE("course: a chain that no step follows ends with the joint that came apart") {
  World world(chainOf("course", 3, 1e6, kLevel));
  world.advance(2.0);
  const Certificate& books = world.report().certificate;
  CAPTURE(world.report().reason, books.energy_end, books.max_joint_gap);
  CHECK(world.report().stopped);
  CHECK(world.report().reason.find("joint \"pin") == 0);
  CHECK(std::abs(books.energy_end) < 1e-3 * 1e6 * 9.81 * 3.0 * kLink);
  CHECK(books.max_joint_gap < 1e-4);  // measured 1e-5
}

// Oracle: statics. Two forces along one line carry no load across it, whatever the step.
TEST_CASE("a chain that is straight between two pins ends with words about slack") {
  const auto [method, step] = GENERATE(
      table<const char*, const char*>({{"stepping", "stepping.step"}, {"course", "course.step"}}));
  WorldDef def = chainOf(method, 4, 1.0, kLevel);
  const Vec3 end = def.bodies.back().position;
  def.joints.push_back({.name = "far", .a = 3, .anchorA = end, .anchorB = end});
  World world(def);
  world.advance(2.0);
  CAPTURE(world.report().reason);
  CHECK(world.report().stopped);
  CHECK(world.report().reason.find(std::string("came apart; try a smaller ") + step +
                                   ", or slack") != std::string::npos);
}

// Oracle: the count of evaluations, and the chain as above.
TEST_CASE("auto leaves a heavy chain to stepping after so much work, and swings it on") {
  World world(chainOf("auto", 3, 1e6, kLevel));
  world.advance(2.0);
  const Report& report = world.report();
  CAPTURE(report.certificate.evaluations, report.certificate.energy_end);
  CHECK(world.method() == "auto: exact, then stepping");
  CHECK_FALSE(report.stopped);
  CHECK(report.certificate.evaluations < 400'000);
  CHECK(world.sample(2.0).bodies.back().x.norm() < 3.0 * kLink * (1.0 + 1e-3));
  CHECK(report.certificate.energy_end < 1e-3 * 1e6 * 9.81);
}

// Oracle: closed form, v = 5/7 g sin(theta) t. Measured to 0 digits off, allowed 1e-12, after more
// than a thousand stretches.
TEST_CASE("auto follows a ball of a millimetre down a slope exactly all the way") {
  const double r = 1e-3;
  WorldDef def = worldOf("auto", 2.0, {ground(0.0, 0.8)});
  const Vec3 n = Vec3(1.0, 1.0, 0.5).normalized();
  def.bodies[0].shape = HalfSpace{n, 0.0};
  def.bodies.push_back(ball("ball", r, r * n, 0.0, 0.8));
  World world(def);
  world.advance(2.0);
  const double v = world.sample(2.0).bodies[1].v.norm();
  const double expected = 5.0 / 7.0 * 9.81 * std::sqrt(1.0 - n.y() * n.y()) * 2.0;
  CAPTURE(v - expected, world.report().certificate.steps);
  CHECK(world.method() == "auto: exact");
  CHECK(world.report().certificate.steps > 100);
  CHECK(std::abs(v / expected - 1.0) < 1e-12);
}
