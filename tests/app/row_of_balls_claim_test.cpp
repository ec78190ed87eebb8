// The claim of Newton's cradle: its one-dimensional row against closed forms, and runs held to it.
#include <cmath>

#include "app/claim/ball_row.h"
#include "tests/app/claims.h"
#include "tests/app/runs.h"

using namespace tumble;

namespace {

// n balls that touch, the first `struck` of which move at 1 m/s.
BallRow ballRow(const char* law, std::vector<double> m, std::vector<double> e, int struck = 1) {
  BallRow row;
  row.u.assign(m.size(), 0.0);
  for (int i = 0; i < struck; ++i) row.u[i] = 1.0;
  row.x.assign(m.size(), 0.0);
  row.gap.assign(m.size() - 1, 0.0);
  row.m = std::move(m);
  row.e = std::move(e);
  row.law = law;
  return row;
}

double worst(BallRow row, const std::vector<double>& exact) {
  row.hit();
  CHECK(row.ended);
  double error = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    error = std::max(error, std::abs(row.u[i] - exact[i]));
  return error;
}

Scene cradle(const std::string& law) {
  return demo("cradle", {"world.impact=" + law});
}

}  // namespace

// Oracle: closed forms. What hands velocities on does so ball by ball; Newton's law at all contacts
// turns that of the struck one round and leaves the others closed. Measured 3e-16, allowed 1e-14.
TEST_CASE("in one dimension n equal balls end as each law says in closed form") {
  for (const int n : {2, 3, 5, 9, 100}) {
    const std::vector<double> m(n, 1.0), e(n - 1, 1.0);
    std::vector<double> handed(n, 0.0), together(n, 2.0 / n);
    handed.back() = 1.0;
    together.front() = 2.0 / n - 1.0;
    CHECK(worst(ballRow("reflections", m, e), handed) < 1e-14);
    CHECK(worst(ballRow("sequential", m, e), handed) < 1e-14);
    CHECK(worst(ballRow("simultaneous", m, e), together) < 1e-14);
    CHECK(worst(ballRow("poisson", m, e), together) < 1e-14);
  }
  const std::vector<double> m(5, 1.0), e(4, 1.0);
  CHECK(worst(ballRow("reflections", m, e, 2), {0.0, 0.0, 0.0, 1.0, 1.0}) < 1e-14);
  CHECK(worst(ballRow("simultaneous", m, e, 2), {-0.2, -0.2, 0.8, 0.8, 0.8}) < 1e-14);
}

// Oracle: closed forms by hand. 4, 2 and 1 kg: pairs hit one after the other, or 4 kg hit 3 kg. A
// first contact with e = 0: each law answers otherwise.
TEST_CASE("in one dimension unlike balls and contacts end as worked out by hand") {
  const std::vector<double> m = {4.0, 2.0, 1.0}, one(3, 1.0), e(2, 1.0), soft = {0.0, 1.0};
  const std::vector<double> inTurn = {1.0 / 3.0, 4.0 / 9.0, 16.0 / 9.0};
  const std::vector<double> both = {1.0 / 7.0, 8.0 / 7.0, 8.0 / 7.0};
  CHECK(worst(ballRow("reflections", m, e), inTurn) < 1e-14);
  CHECK(worst(ballRow("sequential", m, e), inTurn) < 1e-14);
  CHECK(worst(ballRow("simultaneous", m, e), both) < 1e-14);
  CHECK(worst(ballRow("poisson", m, e), both) < 1e-14);

  const double sixth = 1.0 / 6.0;
  CHECK(worst(ballRow("reflections", one, soft), {sixth, sixth, 4.0 * sixth}) < 1e-14);
  CHECK(worst(ballRow("sequential", one, soft), {0.25, 0.25, 0.5}) < 1e-14);
  CHECK(worst(ballRow("simultaneous", one, soft), {2.0 * sixth, 2.0 * sixth, 2.0 * sixth}) < 1e-14);
  CHECK(worst(ballRow("poisson", one, soft), {sixth, sixth, 4.0 * sixth}) < 1e-14);
}

// Oracle: the claim, worked out in one dimension by another method. Measured 4e-16 m/s, allowed
// 1e-9.
TEST_CASE("runs of a cradle keep the claim under each law, and no other law's") {
  for (const char* law : {"reflections", "sequential", "simultaneous", "poisson"}) {
    CAPTURE(law);
    const Scene scene = cradle(law);
    const Recording recording = record(scene, scene.image.rate);
    CHECK(holds("row-of-balls", scene, recording));
    Scene other = scene;
    other.world.impact = scene.world.impact == "simultaneous" ? "reflections" : "simultaneous";
    CHECK_FALSE(holds("row-of-balls", other, recording));
    CHECK_FALSE(holdsBroken("row-of-balls", scene, recording, [](Recording& broken) {
      broken.samples.back().bodies.front().v.x() *= -1.0;
      broken.samples.back().bodies.front().v.y() += 1e-8;
    }));
    CHECK_FALSE(holdsBroken("row-of-balls", scene, recording, [](Recording& broken) {
      for (Sample& sample : broken.samples) sample.bodies.back().x.x() += 1e-8;
    }));
  }
}
