// Events that crowd, in the exact method: every run ends, and bodies beside it see nothing of it.
#include <algorithm>
#include <numbers>

#include "sim/method/exact/pace.h"
#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

TEST_CASE("a crowd of events makes the look coarser, and calm makes it fine again") {
  Pace pace;
  for (int k = 0; k < Pace::kMany; ++k) pace.see(1e-6 * k, 1);
  CHECK(pace.level == 0);
  CHECK(pace.coarseness() == 1.0);
  pace.see(0.01, 1);
  CHECK(pace.level == 1);
  CHECK(pace.coarseness() == Pace::kCoarser);
  CHECK(pace.slackness() == 1.0);
  pace.see(0.01 + 0.9 * Pace::kCalm, 1);
  CHECK(pace.level == 1);
  pace.see(0.01 + Pace::kCalm, 1);
  CHECK(pace.level == 0);
  for (int k = 0; k <= Pace::kCoarsest; ++k) {
    CHECK_FALSE(pace.lost());
    pace.see(1.0, pace.most() + 1);
  }
  CHECK(pace.lost());
}

// Oracle: the same box alone. While a ball rolls on a table, which is followed, a box hits the
// ground, and flies on from where it hit. Measured 3.6e-12 m, allowed 1e-9; overlap 8.4e-12 m.
TEST_CASE("a box that hits the ground beside a ball that rolls flies on from where it hit") {
  BodyDef table = box("table", {2.0, 0.5, 2.0}, {5.0, 0.25, 0.0}, 0.0, 0.5);
  table.fixed = true;
  BodyDef rolling = ball("ball", 0.1, {4.5, 0.6, 0.0}, 0.0, 0.5);
  rolling.velocity = {0.5, 0.0, 0.0};
  rolling.angularVelocity = {0.0, 0.0, -5.0};
  BodyDef thrown = box("thrown", {0.3, 0.2, 0.4}, {0.0, 0.5, 0.0}, 0.8, 0.3);
  thrown.angularVelocity = {1.0, 2.0, 3.0};
  const BodyDef floor = ground(0.0, 0.3);
  World alone(worldOf("exact", 0.6, {floor, thrown}));
  World beside(worldOf("exact", 0.6, {floor, table, rolling, thrown}));
  const BodySample one = run(alone).bodies[1], other = run(beside).bodies[3];
  REQUIRE(alone.report().events.size() >= 2);
  const double apart = (one.x - other.x).norm();
  CAPTURE(apart);
  CHECK(apart < 1e-9);
  CHECK(beside.report().certificate.max_penetration < 1e-11);
}

// Oracle: the run ends, with books that close. Two boxes on a turntable are about to slide and to
// tip; a dropped box clatters from corner to corner. Balance measured 3e-11, allowed 1e-8; overlap
// 3.6e-11 m, allowed 1e-9.
TEST_CASE("boxes on a turntable and boxes that clatter come to an end") {
  BodyDef upper = box("upper", {0.4, 0.4, 0.4}, {0.8, 0.6, 0.0}, 0.0, 0.5);
  BodyDef lower = box("lower", {0.4, 0.4, 0.4}, {0.8, 0.2, 0.0}, 0.0, 0.5);
  BodyDef clatter = box("clatter", {0.4, 0.1, 0.3}, {0.0, 0.4, 0.0}, 0.5, 0.3);
  clatter.orientation = Quat(1.0, 0.01, 0.0, 0.02).normalized();
  for (const WorldDef& def : {worldOf("exact", 0.1, {turntable(2.0, 0.5), lower, upper}),
                              worldOf("exact", 1.0, {ground(0.5, 0.3), clatter})}) {
    World world(def);
    run(world);
    const Certificate& books = world.report().certificate;
    CAPTURE(world.report().reason, books.steps, books.energy_balance_error, books.max_penetration);
    CHECK_FALSE(world.report().stopped);
    CHECK(books.steps < 5000);
    CHECK(books.energy_balance_error < 1e-8);
    CHECK(books.max_penetration < 1e-9);
  }
}

// Oracle: invariant. A box comes to lie with an edge on the rim of a cylinder: it is followed all
// the way, and nothing crowds. Where the gap of that contact bent wrongly, it took 5868 steps, most
// of them across events, and left 9.5e-6 m of overlap. Measured 303 steps, no overlap; allowed 1000
// and 1e-9 m, and a balance of 1e-8.
TEST_CASE("an edge that rolls over a rim is followed, and nothing crowds") {
  const auto thrown = [](BodyDef def, double mass, const Vec3& v, const Vec3& omega,
                         const Vec3& axis, double degrees) {
    def.mass = mass;
    def.velocity = v;
    def.angularVelocity = omega;
    def.orientation = fromAxisAngle(axis.normalized(), degrees * std::numbers::pi / 180.0);
    return def;
  };
  BodyDef slope = ground(0.3, 0.6);
  slope.shape = HalfSpace{Vec3(0.09983341664682815, 0.9950041652780258, 0.0), 0.0};
  BodyDef drum = ball("drum", 1.0,
                      {-0.03399024742068639, 0.41769845741596656, -0.05512142080598481}, 0.3, 0.6);
  drum.shape = Cylinder{0.154, 0.318};
  const BodyDef lower =
                    box("lower", {0.308, 0.347, 0.338},
                        {0.028624717642078912, 1.1637568863080514, -0.05455577919267234}, 0.3, 0.6),
                upper =
                    box("upper", {0.224, 0.287, 0.309},
                        {0.06388808506360172, 2.054393888879019, 0.02509276984263159}, 0.3, 0.6);
  World world(
      worldOf("exact", 0.64,
              {slope,
               thrown(drum, 2.0, {-0.3613227125647036, -0.6220620264300913, 0.9447505006829322},
                      {-1.3686464435978074, 0.8302761848677163, 0.8599536674539543},
                      {-2.1630614929438106, -0.8048913596062219, -0.26111942804421945}, 114.3),
               thrown(lower, 0.5, {-0.5978547496972639, -0.11457749797275918, 0.8124018563697009},
                      {0.6494689857955107, -2.9870329934559097, 0.9846156364234675},
                      {0.3731355278123243, -0.23406156455107607, 2.29439036361027}, 96.1),
               thrown(upper, 1.0, {-0.0012034986848223905, 0.6531216281144503, -0.3989801094954506},
                      {2.8600846748196878, 2.0653990815121306, -2.7981161471162057},
                      {1.1448130957390998, -0.24531093675906787, 1.397236551221062}, 64.5)}));
  run(world);
  const Certificate& books = world.report().certificate;
  CAPTURE(world.report().reason, books.steps, books.energy_balance_error, books.max_penetration);
  CHECK_FALSE(world.report().stopped);
  CHECK(world.report().notes.empty());
  CHECK(books.steps < 1000);
  CHECK(books.energy_balance_error < 1e-8);
  CHECK(books.max_penetration < 1e-9);
}

// Oracle: invariant. At rest the books are weighed by what the loads would do if nothing held them.
// Measured 1e-15, allowed 1e-12.
TEST_CASE("the books of a scene at rest are numbers, with loads and without") {
  const std::string method = GENERATE("course", "stepping", "exact");
  WorldDef def = worldOf("exact", 0.5, {ground(), box("box", {0.4, 0.4, 0.4}, {0.0, 0.2, 0.0})});
  def.method = method;
  const bool loaded = GENERATE(true, false);
  if (!loaded) def.gravity.setZero();
  World world(def);
  run(world);
  const Certificate& books = world.report().certificate;
  CAPTURE(method, loaded, books.energy_balance_error, books.momentum_error);
  CHECK(books.energy_balance_error < 1e-12);
  CHECK(books.momentum_error < 1e-12);
}
