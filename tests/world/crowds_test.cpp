// Crowds in steps: what many bodies do that meet at once.
#include <cmath>

#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

double deepestOfBalls(const Sample& sample, double r) {
  double deepest = 0.0;
  for (std::size_t i = 0; i < sample.bodies.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      deepest = std::max(deepest, 2.0 * r - (sample.bodies[i].x - sample.bodies[j].x).norm());
  return deepest;
}

}  // namespace

// Oracle: nothing passes through another, and momentum. A ball meets one at rest, whose neighbour
// is out of reach of all that moves before the hit; bodies lifted apart would show as added energy
// or as an overlap at the end of the step. Measured 0 m of overlap, 1e-16 of momentum.
TEST_CASE("stepping: a ball that is pushed meets what was out of its reach before") {
  constexpr double kRadius = 0.1;
  const double e = GENERATE(0.0, 0.5), step = GENERATE(1.0 / 60.0, 1.0 / 30.0);
  const double gap = GENERATE(0.002, 0.05, 0.15);
  WorldDef def =
      worldOf("stepping", 0.3,
              {ball("comes", kRadius, {-1.0, 0.0, 0.0}), ball("first", kRadius, {0.0, 0.0, 0.0}),
               ball("next", kRadius, {2.0 * kRadius + gap, 0.0, 0.0}, e),
               ball("last", kRadius, {4.0 * kRadius + 2.0 * gap, 0.0, 0.0})});
  def.gravity.setZero();
  def.stepping.step = step;
  def.bodies[0].velocity = {30.0, 0.0, 0.0};
  World world(def);
  double deepest = 0.0;
  for (int k = 1; k * step <= def.duration; ++k) {
    world.advance(k * step);
    deepest = std::max(deepest, deepestOfBalls(world.sample(k * step), kRadius));
  }
  CAPTURE(e, step, gap, deepest);
  CHECK(deepest < 1e-9);
  CHECK(world.report().certificate.energy_added_repair == 0.0);
  CHECK(world.report().certificate.momentum_error < 1e-12);
}
