// Bodies that turn far within a step, by stepping: when they hit, and what is left of their energy.
#include <algorithm>
#include <cmath>

#include "tests/catch.h"
#include "tests/collide/random_pose.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

std::vector<double> impactsOf(const World& world) {
  std::vector<double> times;
  for (const Event& event : world.report().events)
    if (event.kind == EventKind::Impact) times.push_back(event.t);
  return times;
}

/// A fast box that tumbles towards a fixed ball of 0.5 m.
WorldDef boxAtBall(Random& random, const char* method, double e) {
  BodyDef peg = ball("peg", 0.5, Vec3::Zero(), e);
  peg.fixed = true;
  BodyDef small = box("small", {0.2, 0.3, 0.25}, {0.0, 1.3, 0.0}, e);
  small.orientation = random.rotation();
  small.velocity = Vec3(0.0, -12.0, 0.0) + random.vector(-1.0, 1.0);
  small.angularVelocity = random.vector(-40.0, 40.0);
  return worldOf(method, 0.15, {peg, small});
}

}  // namespace

// Oracle: the exact method, and energy.
TEST_CASE("a box that tumbles hits when exact says, however long the step, and keeps its energy") {
  int several = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Random random(seed), same(seed);
    const WorldDef def = boxAtBall(random, "stepping", 1.0);
    World world(def), exact(boxAtBall(same, "exact", 1.0));
    world.advance(def.duration);
    exact.advance(def.duration);
    const std::vector<double> hits = impactsOf(world), truth = impactsOf(exact);
    CAPTURE(seed, hits, truth);
    REQUIRE(hits.size() == truth.size());
    several += hits.size() > 1 ? 1 : 0;
    for (std::size_t k = 0; k < hits.size(); ++k)
      CHECK(std::abs(hits[k] - truth[k]) < 1e-12);                   // measured 8e-15
    CHECK(world.report().certificate.energy_balance_error < 1e-12);  // measured 1e-15
  }
  CHECK(several >= 5);
}
