// A step of `stepping` allocates nothing once warm.
#include "tests/allocations.h"
#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

/// Cubes in columns that touch no others, or, bonded, each on two below; at rest, or drifting along
/// a smooth floor, where every step is solved anew.
WorldDef stack(int wide, int high, bool bonded, double speed) {
  WorldDef def = worldOf("stepping", 10.0, {ground(0.0, speed > 0.0 ? 0.0 : 0.5)});
  for (int y = 0; y < high; ++y)
    for (int x = 0; x < wide; ++x) {
      const double aside = bonded && y % 2 ? 0.24 : 0.0;
      def.bodies.push_back(box("box." + std::to_string(def.bodies.size()), {0.5, 0.5, 0.5},
                               {0.51 * x + aside, 0.25 + 0.5 * y, 0.0}, 0.0, 0.5));
      def.bodies.back().velocity = {speed, 0.0, 0.0};
    }
  return def;
}

}  // namespace

TEST_CASE("stepping: a warm step allocates nothing, at rest or in motion") {
  for (const bool bonded : {false, true})
    for (const double speed : {0.0, 0.1}) {
      const WorldDef def = stack(4, 5, bonded, speed);
      World world(def);
      const double h = def.stepping.step;
      for (int k = 1; k <= 100; ++k) world.advance(k * h);
      const long before = test::allocations;
      for (int k = 101; k <= 120; ++k) world.advance(k * h);
      const long after = test::allocations;
      CAPTURE(bonded, speed);
      CHECK(after == before);
    }
}
