// The claim "bouncing": height, energy and hits of a ball, by methods that keep it and others that
// do not.
#include "app/claim/fall.h"
#include "app/file/data.h"
#include "app/panel/chart_run.h"
#include "tests/app/claims.h"

using namespace tumble;

namespace {

Scene ball(const std::vector<std::string>& overrides) {
  return readScene(dataFolder("report") + "/bouncing.toml", overrides);
}

double errorOf(const std::vector<std::string>& overrides) {
  const Scene scene = ball(overrides);
  ChartDef chart;
  chart.error = "bouncing";
  return largestError(chart, scene, record(scene, scene.image.rate));
}

}  // namespace

// Oracle: closed forms. Measured 9e-16 elastic, 9e-16 with e = 0.8, allowed 1e-8.
TEST_CASE("a ball that bounces exactly keeps the claim, and no tampered one does") {
  for (const char* e : {"1.0", "0.8", "0.3", "0.0"}) {
    CAPTURE(e);
    const Scene scene = ball({std::string("materials.rubber.restitution=") + e});
    const Recording recording = record(scene, scene.image.rate);
    CHECK(holds("bouncing", scene, recording));
    CHECK_FALSE(holdsBroken("bouncing", scene, recording,
                            [](Recording& broken) { broken.samples[5].bodies[1].x.y() += 1e-7; }));
    CHECK_FALSE(holdsBroken("bouncing", scene, recording, [](Recording& broken) {
      broken.samples.back().bodies[1].v.y() += 1e-3;
    }));
    CHECK_FALSE(holdsBroken("bouncing", scene, recording, [](Recording& broken) {
      for (Event& event : broken.report.events) event.t += 1e-7;
    }));
  }
}

// Oracle: closed forms of the n-th hit, t₁ (1 + 2 e + 2 e² + …), by hand for e = ½: 1, 2, 5/2 t₁.
TEST_CASE("hits of a ball follow each other as the geometric series says") {
  Fall fall;
  fall.height = 2.0;
  fall.e = 0.5;
  const double t1 = fall.firstHit();
  CHECK(fall.hitTime(1) == Approx(t1).epsilon(1e-15));
  CHECK(fall.hitTime(2) == Approx(2.0 * t1).epsilon(1e-15));
  CHECK(fall.hitTime(3) == Approx(2.5 * t1).epsilon(1e-15));
  CHECK(fall.apexTime(2) == Approx(2.25 * t1).epsilon(1e-15));
}

// Oracle: two methods. Parabolas by Runge-Kutta 4 have no error but that of the instant of the hit;
// Euler's are higher by the step. Measured 2e-11 and a ratio of 2.0.
TEST_CASE("backing up is as right as its integrator, whatever the step") {
  const std::string course = "world.method=course";
  CHECK(errorOf({course, "course.step=0.1"}) < 1e-9);
  CHECK(errorOf({course, "course.step=0.003"}) < 1e-9);
  const auto euler = [&](const char* step) {
    return errorOf({course, "course.integrator=euler", "world.duration=1.0",
                    std::string("course.step=") + step});
  };
  CHECK(euler("0.001") / euler("0.0005") == Approx(2.0).epsilon(0.05));
}
