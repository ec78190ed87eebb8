// The claim of slopes holds for true runs by every method, and fails for untrue ones.
#include "tests/app/claims.h"
#include "tests/app/runs.h"

using namespace tumble;

// Oracle: the closed forms of app/claim/sliding.cpp.
TEST_CASE("blocks and a ball on slopes keep their claim by each method, whatever the scene") {
  for (const char* method : {"exact", "course", "stepping"}) {
    const std::string set = std::string("world.method=") + method;
    for (const char* mu : {"0.05", "0.5", "0.9"}) {
      CAPTURE(method, mu);
      std::vector<std::string> overrides = {set};
      for (const char* material : {"ramp", "stayer", "slider", "rubber"})
        overrides.push_back(std::string("materials.") + material + ".friction=" + mu);
      const Scene scene = demo("slope", overrides);
      CHECK(holds("sliding", scene, record(scene, 60.0)));
    }
  }
}

// Oracle: tan 25° < 0.5 < tan 28°.
TEST_CASE("the claim tells what stays from what slides by the tangent of the slope") {
  const Scene scene = demo("slope");
  const std::vector<ClaimRow> rows = findCheck("sliding")->rows(scene, record(scene, 60.0));
  CHECK(hasRow(rows, "block25 stays at 25°"));
  CHECK(hasRow(rows, "block28 slides at 28°"));
  CHECK(hasRow(rows, "ball slides"));
  CHECK(hasRow(rows, "ball rolls"));
  CHECK(hasRow(rows, "its slip ends"));
  CHECK_FALSE(hasRow(rows, "block28 stays"));
}

TEST_CASE("a wrong acceleration, a creep, and a ball that rolls late break the claim of slopes") {
  const Scene scene = demo("slope");
  const Recording right = record(scene, 60.0);
  CHECK(holds("sliding", scene, right));
  const auto bodyNamed = [&](const char* name) {
    int body = 0;
    while (scene.world.bodies[body].name != name) ++body;
    return body;
  };
  for (const char* name : {"block5", "block45", "ball"}) {
    CAPTURE(name);
    CHECK_FALSE(holdsBroken("sliding", scene, right, [&](Recording& r) {
      r.samples[10].bodies[bodyNamed(name)].v.x() += 1e-9;
    }));
  }
  CHECK_FALSE(holdsBroken("sliding", scene, right, [](Recording& r) {
    for (Event& event : r.report.events)
      if (event.kind == EventKind::Stick) event.t += 1e-8;
  }));
}

TEST_CASE("without a plane that stands still the claim of slopes says so") {
  const Scene scene = demo("slope", {"world.gravity=[0.0, 9.81, 0.0]", "world.duration=0.1"});
  const Recording recording = record(scene, 60.0);
  CHECK_FALSE(holds("sliding", scene, recording));
}
