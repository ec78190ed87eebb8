// A step of `stepping` allocates nothing once warm.
#include "tests/allocations.h"
#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

/// How much twenty steps allocate, after a hundred.
long allocatedBy(const WorldDef& def) {
  World world(def);
  const double h = def.stepping.step;
  for (int k = 1; k <= 100; ++k) world.advance(k * h);
  const long before = test::allocations;
  for (int k = 101; k <= 120; ++k) world.advance(k * h);
  return test::allocations - before;
}

}  // namespace

TEST_CASE("stepping: a warm step allocates nothing, at rest or in motion") {
  for (const bool bonded : {false, true})
    for (const double speed : {0.0, 0.1}) {
      CAPTURE(bonded, speed);
      CHECK(allocatedBy(stackOf(4, 5, 1, bonded, speed)) == 0);
    }
  for (const double friction : {0.0, 0.3}) {
    WorldDef rolling = worldOf("stepping", 10.0, {ground(0.0, friction)});
    rolling.bodies.push_back(ball("ball", 0.1, {0.0, 0.1, 0.0}, 0.0, friction));
    rolling.bodies[1].velocity = {1.0, 0.0, 0.0};
    CAPTURE(friction);
    CHECK(allocatedBy(rolling) == 0);
  }
}
