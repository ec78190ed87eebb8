// The claim of what spins on a floor holds for true runs and fails for untrue ones.
#include "app/file/data.h"
#include "tests/app/claims.h"
#include "tests/app/runs.h"

using namespace tumble;

namespace {

bool hasSpinsRow(const Scene& scene, const Recording& recording, const std::string& text) {
  return hasRow(findCheck("spins")->rows(scene, recording), text);
}

constexpr int kDisk = 1, kTop = 2, kPill = 3;  // in the scene's order

}  // namespace

// Oracle: what keeps L · r and what takes energy, for a pill that gets up while it slips and hops.
TEST_CASE("a pill that gets up keeps Jellett's integral, whatever its friction") {
  for (const char* mu : {"0.01", "0.25"}) {
    CAPTURE(mu);
    const Scene scene = demo("tops", {"body.disk.fixed=true", "body.top.fixed=true",
                                      std::string("materials.glass.friction=") + mu,
                                      "body.pill.position=[0.5, 0.032778370842670886, 0.0]",
                                      "body.pill.orientation={ axis = [0, 0, 1], degrees = -80 }",
                                      "body.pill.angular_velocity=[0.0, 280.0, 0.0]"});
    const Recording recording = record(scene, scene.image.rate);
    CHECK(hasSpinsRow(scene, recording, "Jellett"));
    CHECK(holds("spins", scene, recording));
    CHECK(recording.samples.back().kinetic < 0.95 * recording.samples.front().kinetic);
  }
}

// Oracle: the scene. Only the right spin keeps the centre of a disk where it is; a top on ice
// slips.
TEST_CASE("a disk that nods is not held to a steady one, nor a tip on ice to a pivot") {
  const Scene steady = demo("tops");
  const Recording one = record(steady, 60.0);
  CHECK(hasSpinsRow(steady, one, "rolls round its rim"));
  CHECK(hasSpinsRow(steady, one, "on its tip"));
  const Scene nods =
      demo("tops", {"body.disk.angular_velocity=[-8.48396853471933, 1.9372302812097821, 0.0]"});
  const Recording other = record(nods, 60.0);
  CHECK_FALSE(hasSpinsRow(nods, other, "rolls round its rim"));
  CHECK(holds("spins", nods, other));
}

TEST_CASE(
    "energy from nowhere, a centre that wanders and a tip that turns wrongly break the claim") {
  const Scene scene = demo("tops", {"world.duration=0.3"});
  const Recording right = record(scene, scene.image.rate);
  CHECK(holds("spins", scene, right));
  CHECK_FALSE(holdsBroken("spins", scene, right,
                          [](Recording& r) { r.samples[40].bodies[kDisk].omega *= 1.0 + 1e-8; }));
  CHECK_FALSE(holdsBroken("spins", scene, right,
                          [](Recording& r) { r.samples[40].bodies[kDisk].x.x() += 1e-8; }));
  CHECK_FALSE(holdsBroken("spins", scene, right, [](Recording& r) {
    r.samples[40].bodies[kTop].q = r.samples[39].bodies[kTop].q;
  }));
  CHECK_FALSE(holdsBroken("spins", scene, right,
                          [](Recording& r) { r.samples[40].bodies[kPill].omega *= 1.0 - 1e-8; }));
}

TEST_CASE("where nothing spins on a floor the claim says so") {
  const Scene scene =
      readScene(dataFolder("demos") + "/stacked-boxes.toml", {"world.duration=0.1"});
  CHECK_FALSE(holds("spins", scene, record(scene, 60.0)));
}
