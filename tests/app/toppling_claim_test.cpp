// The claim of dominoes holds for true runs and fails for untrue ones.
#include <algorithm>

#include "app/file/data.h"
#include "tests/app/claims.h"
#include "tests/app/runs.h"

using namespace tumble;

// Oracles: the closed forms of app/claim/toppling.cpp.
TEST_CASE("dominoes keep their claim at another distance, height and gravity") {
  for (const std::vector<std::string>& set : std::vector<std::vector<std::string>>{
           {"array.domino.step=[0.06, 0.0, 0.0]", "array.domino.body.position=[0.06, 0.05, 0.0]"},
           {"array.domino.body.shape={ box = [0.01, 0.12, 0.05] }",
            "array.domino.body.position=[0.05, 0.06, 0.0]"},
           {"world.gravity=[0.0, -1.6, 0.0]", "world.duration=3.0"}}) {
    std::vector<std::string> overrides = {"array.domino.count=4"};
    overrides.insert(overrides.end(), set.begin(), set.end());
    const Scene scene = demo("dominoes", overrides);
    CHECK(holds("toppling", scene, record(scene, 60.0)));
  }
}

TEST_CASE(
    "a late first hit, a hit too low, a wrong order and energy from nowhere break the claim") {
  const Scene scene = demo("dominoes", {"array.domino.count=4", "world.duration=1.2"});
  const Recording right = record(scene, 60.0);
  CHECK(holds("toppling", scene, right));
  const auto hits = [](Recording& r, int a, int b) -> Event& {
    return *std::find_if(r.report.events.begin(), r.report.events.end(),
                         [&](const Event& e) { return e.a == a && e.b == b; });
  };
  CHECK_FALSE(
      holdsBroken("toppling", scene, right, [&](Recording& r) { hits(r, 2, 1).t += 0.01; }));
  CHECK_FALSE(
      holdsBroken("toppling", scene, right, [&](Recording& r) { hits(r, 3, 2).p.y() *= 0.97; }));
  CHECK_FALSE(holdsBroken("toppling", scene, right, [&](Recording& r) { hits(r, 4, 3).t = 0.1; }));
  CHECK_FALSE(holdsBroken("toppling", scene, right, [&](Recording& r) {
    r.samples[20].kinetic += 0.2 * r.samples[0].potential;
  }));
  CHECK_FALSE(holdsBroken("toppling", scene, right, [](Recording& r) {
    for (Sample& sample : r.samples) sample.bodies[3].q = Quat::Identity();
  }));
}

TEST_CASE("without a box that leans towards others the claim of dominoes says so") {
  const Scene scene =
      readScene(dataFolder("demos") + "/stacked-boxes.toml", {"world.duration=0.1"});
  CHECK_FALSE(holds("toppling", scene, record(scene, 60.0)));
}
