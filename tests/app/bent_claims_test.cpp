// The claims of points of what bends that touch solids: the step that they are held in is that of
// the world, and they say nothing of scenes without any.
#include "app/claim/holds.h"
#include "tests/app/claims.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

constexpr const char* kHangingCloth = R"([world]
duration = 0.2
[stepping]
step = 0.016666666666666666
[[body]]
name = "bar"
shape = { box = [1, 0.1, 0.1] }
fixed = true
position = [0, 3, 0]
[[cloth]]
name = "cloth"
columns = 6
rows = 5
size = [0.5, 0.4]
density = 0.2
stretch = 300.0
shear = 40.0
bend = 1e-3
damping = 0.3
position = [0, 1, 0]
)";

}  // namespace

// Oracle: two methods agree. A cloth that swings by two corners moves as Newton's solver of contact
// problems has it; each of its steps is one with held points. Measured 4e-14 of the largest Δv,
// allowed 1e-10.
TEST_CASE("a step with held points is the step of the world") {
  const Scene scene =
      parseScene(std::string(kHangingCloth) + "pins = [[0, 0], [5, 0]]\n", "s.toml");
  const Recording recording = record(scene, 1.0 / scene.world.stepping.step);
  for (std::size_t k = 1; k < recording.samples.size(); ++k) {
    const Sample &before = recording.samples[k - 1], &after = recording.samples[k];
    const HeldProblem problem = heldStep(scene, before);
    REQUIRE(problem.holds.size() == 6);
    const HeldAnswer answer = solveMultipliers(problem, 1e-12);
    double largest = 0.0, off = 0.0;
    for (std::size_t p = 0; p < answer.dv.size(); ++p) {
      const Vec3 change = after.bodies[p + 1].v - before.bodies[p + 1].v;
      largest = std::max(largest, change.norm());
      off = std::max(off, (change - answer.dv[p]).norm());
    }
    CAPTURE(k, largest, off);
    CHECK(largest > 1e-3);
    CHECK(off <= 1e-10 * largest);
  }
}

TEST_CASE("claims of points that touch say nothing of scenes in which none does") {
  const Scene falls = parseScene(kHangingCloth, "s.toml");
  const Recording recording = record(falls, 60.0);
  CHECK_FALSE(holds("holds", falls, recording));
  CHECK_FALSE(holds("point-plans", falls, recording));
  const Scene pinned = parseScene(std::string(kHangingCloth) + "pins = \"corners\"\n", "s.toml");
  CHECK_FALSE(holds("holds", pinned, record(pinned, 60.0)));
}
