// The claim of crowds holds for true runs and fails for untrue ones.
#include "app/file/data.h"
#include "tests/app/claims.h"

using namespace tumble;

namespace {

// A wall of thirteen bricks, and its ball.
Scene smallWall(const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {"array.wall.rows=3", "array.wall.columns=4",
                                        "body.ball.position=[0.0, 0.5, 1.0]", "world.duration=0.4"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return readScene(dataFolder("demos") + "/wall-and-ball.toml", overrides);
}

}  // namespace

// Oracle: conservation. What is measured and what is allowed stands in app/claim/crowd.cpp.
TEST_CASE("a crowd keeps its claim, and a rise, a loss unaccounted for and an overlap break it") {
  const Scene scene = smallWall();
  const Recording right = record(scene, 60.0);
  CHECK(holds("crowd", scene, right));
  double most = 0.0;
  for (const Sample& sample : right.samples) most = std::max(most, sample.kinetic);
  const auto broken = [&](const std::function<void(Recording&)>& breakIt) {
    return holdsBroken("crowd", scene, right, breakIt);
  };
  CHECK_FALSE(broken([&](Recording& r) { r.samples[2].potential += 0.01 * most; }));
  CHECK_FALSE(
      broken([&](Recording& r) { r.report.certificate.energy_lost_impact += 0.04 * most; }));
  CHECK_FALSE(broken([&](Recording& r) {
    r.report.certificate.energy_added_repair += 0.04 * most;
    r.report.certificate.energy_lost_impact += 0.04 * most;
  }));
  CHECK_FALSE(broken([](Recording& r) { r.report.certificate.momentum_error = 1e-8; }));
  CHECK_FALSE(broken([](Recording& r) { r.report.certificate.max_penetration = 2e-4; }));
}

TEST_CASE("where something feeds energy in, or nothing moves, the claim of crowds says so") {
  Scene pushed = smallWall({"world.duration=0.1"});
  pushed.world.forces.emplace_back(UniformWind{});
  CHECK_FALSE(holds("crowd", pushed, record(pushed, 60.0)));
  const Scene still = smallWall(
      {"body.ball.position=[0.0, 0.4, 1.0]", "body.ball.velocity=[0, 0, 0]", "world.duration=0.1"});
  CHECK_FALSE(holds("crowd", still, record(still, 60.0)));
}
