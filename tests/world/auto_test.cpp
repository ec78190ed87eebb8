// The method "auto": what it chooses, that it adds nothing to what it chose, and how it goes on
// where the exact method gives up.
#include <algorithm>

#include "sim/method/method.h"
#include "tests/catch.h"
#include "tests/problem/problems.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

WorldDef towerOf(int n) {
  WorldDef def = worldOf("auto", 1.0, {ground(0.0, 0.5)});
  addColumn(def, n, 0.5, {0.1, 0.25, -0.3}, 0.0, 0.5);
  return def;
}

/// Balls that fly about, with or without a floor to fall on.
WorldDef balls(int n, bool floor) {
  WorldDef def = worldOf("auto", 1.0, {});
  if (floor) def.bodies.push_back(ground(0.5, 0.3));
  for (int i = 0; i < n; ++i) {
    def.bodies.push_back(ball("ball" + std::to_string(i), 0.1, {0.5 * i, 1.0, 0.0}, 0.5, 0.3));
    def.bodies.back().velocity = {0.1 * (i % 3), 0.2 * (i % 5), 0.3};
  }
  return def;
}

WorldDef sprung(bool floor) {
  WorldDef def = worldOf("auto", 1.0, {ball("ball", 0.1, {0.0, 1.0, 0.0})});
  if (floor) def.bodies.push_back(ground());
  def.forces = {Spring{.a = 0, .stiffness = 50.0, .rest = 0.5}};
  return def;
}

WorldDef pendulums(int n) {
  WorldDef def = worldOf("auto", 1.0, {});
  for (int i = 0; i < n; ++i) {
    def.bodies.push_back(box("rod" + std::to_string(i), {0.1, 1.0, 0.1}, {2.0 * i, 0.0, 0.0}));
    const Vec3 pin(2.0 * i, 0.5, 0.0);
    def.joints.push_back({.name = "pin" + std::to_string(i),
                          .kind = JointKind::Ball,
                          .a = i,
                          .anchorA = pin,
                          .anchorB = pin});
  }
  return def;
}

/// Boxes that tumble onto a floor, where each rattles, slides and tips.
WorldDef tumbling(int n, std::uint64_t seed, double duration) {
  test::Draw draw(seed);
  WorldDef def = worldOf("auto", duration, {ground(0.2, 0.4)});
  for (int i = 0; i < n; ++i) {
    const double y = draw(0.5, 1.5), x = draw(-1.0, 1.0), z = draw(-1.0, 1.0), w = draw(-1.0, 1.0);
    BodyDef b = box("box" + std::to_string(i), {0.2, 0.15, 0.3}, {0.6 * i, y, 0.0}, 0.2, 0.4);
    b.orientation = fromAxisAngle(Vec3(x, w, z).normalized(), draw(-3.0, 3.0));
    def.bodies.push_back(b);
  }
  return def;
}

/// Balls one above the other in a shaft of half a metre's width.
WorldDef shaft(int n, std::uint64_t seed, double duration) {
  test::Draw draw(seed);
  WorldDef def = worldOf("auto", duration, {ground(0.2, 0.4)});
  for (int k = 0; k < 4; ++k) {
    BodyDef wall = ground(0.2, 0.4);
    wall.name = "wall" + std::to_string(k);
    const double side = k % 2 ? 1.0 : -1.0;
    wall.shape = HalfSpace{k < 2 ? Vec3(side, 0.0, 0.0) : Vec3(0.0, 0.0, side), -0.25};
    def.bodies.push_back(wall);
  }
  for (int i = 0; i < n; ++i) {
    const double x = draw(-0.08, 0.08), z = draw(-0.08, 0.08);
    def.bodies.push_back(ball("ball" + std::to_string(i), 0.08, {x, 0.3 + 0.3 * i, z}, 0.2, 0.4));
  }
  return def;
}

double lowestCorner(const Sample& sample) {
  double lowest = 1.0;
  for (std::size_t i = 1; i < sample.bodies.size(); ++i) {
    const Mat3 R = sample.bodies[i].q.toRotationMatrix();
    lowest = std::min(lowest, sample.bodies[i].x.y() -
                                  R.row(1).cwiseAbs().dot(Vec3(0.1, 0.075, 0.15).transpose()));
  }
  return lowest;
}

bool sameBits(const Sample& p, const Sample& q) {
  bool same = p.contacts.size() == q.contacts.size();
  for (std::size_t i = 0; i < p.bodies.size(); ++i)
    same = same && p.bodies[i].x == q.bodies[i].x && p.bodies[i].v == q.bodies[i].v &&
           p.bodies[i].q.coeffs() == q.bodies[i].q.coeffs() &&
           p.bodies[i].omega == q.bodies[i].omega;
  return same;
}

struct Choice {
  const char* scene;
  WorldDef def;
  const char* method;
};

std::vector<Choice> choices() {
  return {{"a ball on a floor", balls(1, true), "exact"},
          {"a few boxes", towerOf(4), "exact"},
          {"a high tower", towerOf(20), "stepping"},
          {"many balls over a floor", balls(40, true), "stepping"},
          {"many balls and no floor", balls(40, false), "exact"},
          {"a spring over a floor", sprung(true), "stepping"},
          {"a spring and nothing to touch", sprung(false), "stepping"},
          {"a few joints", pendulums(2), "exact"},
          {"many joints", pendulums(20), "stepping"}};
}

}  // namespace

// Oracle: the counts. The motion is that of the chosen method, bit by bit.
TEST_CASE("auto chooses by what a scene holds, and moves as what it chose") {
  for (const Choice& choice : choices()) {
    WorldDef def = choice.def;
    REQUIRE(def.method == "auto");
    World chosen(def);
    def.method = choice.method;
    World named(def);
    CAPTURE(choice.scene);
    CHECK(chosen.method() == std::string("auto: ") + choice.method);
    CHECK(chosen.runs() == choice.method);
    CHECK(named.method() == choice.method);
    CHECK(chosen.features() == named.features());
    CHECK(sameBits(run(chosen), run(named)));
  }
}

// Oracle: the floor, and bit-equal motion however it is looked at. Measured 1.2e-11 m, allowed
// 1e-9.
TEST_CASE("auto goes on by stepping where the exact method gives up") {
  const WorldDef def = tumbling(4, 12, 1.0);
  World often(def), once(def);
  double lowest = 1.0;
  for (int k = 0; k <= 80; ++k) {  // ends of steps: inside one, a turning corner dips
    often.advance(k / 80.0);
    lowest = std::min(lowest, lowestCorner(often.sample(k / 80.0)));
  }
  once.advance(1.0);
  const Report& report = often.report();
  CAPTURE(often.method(), lowest);
  CHECK(often.method() == "auto: exact, then stepping");
  CHECK(often.runs() == "stepping");
  CHECK_FALSE(report.stopped);
  CHECK(std::any_of(report.notes.begin(), report.notes.end(), [](const std::string& note) {
    return note.find("by stepping: the exact method") != std::string::npos;
  }));
  CHECK(lowest > -1e-9);
  CHECK(report.certificate.momentum_error < 1e-9);
  CHECK(report.certificate.energy_balance_error < 0.05);
  CHECK(sameBits(often.sample(1.0), once.sample(1.0)));
  CHECK(std::is_sorted(report.events.begin(), report.events.end(),
                       [](const Event& p, const Event& q) { return p.t < q.t; }));
}

// Oracle: conservation. A coin on its edge rattles before it rolls: steps of stepping leave a tenth
// of its energy open. Measured 3.7e-8 of the largest kinetic energy, allowed 1e-6.
TEST_CASE("auto follows a coin that spins on a table by the exact method, to the end") {
  WorldDef def = worldOf("auto", 1.0, {ground(0.3, 0.2)});
  BodyDef coin;
  coin.name = "coin";
  coin.shape = Cylinder{0.012, 0.002};
  coin.density = 7800.0;
  coin.restitution = 0.3;
  coin.friction = 0.2;
  coin.position = {0.0, 0.0121, 0.0};
  coin.orientation = fromAxisAngle(Vec3::UnitX(), std::numbers::pi / 2);
  coin.angularVelocity = {0.5, 40.0, 0.0};
  def.bodies.push_back(coin);
  World world(def);
  run(world);
  CHECK(world.method() == "auto: exact");
  CHECK_FALSE(world.report().stopped);
  CHECK(world.report().certificate.energy_balance_error < 1e-6);
}

TEST_CASE("auto says why the exact method gave up, and what to set, in words of a scene") {
  State state;
  state.effort.done = 1'500'000;
  Model model;
  model.def.method = "exact";
  CHECK(spentBy(model, state) ==
        "the exact method takes too long where things move or touch as fast as here (1500000 "
        "evaluations of forces so far); set world.method = \"stepping\", or \"auto\", which goes "
        "on by it");
  model.def.method = "auto";
  CHECK(spentBy(model, state) ==
        "the exact method takes too long where things move or touch as fast as here (1500000 "
        "evaluations of forces so far); for steps throughout set world.method = \"stepping\", to "
        "wait for it \"exact\"");
}

// Oracle: walls and floor. Four balls fall into a narrow shaft, where some slide while others fly.
// Measured 8e-12 m, allowed 1e-9.
TEST_CASE("exact: balls that fall into a shaft stay in it, whoever is looked for meanwhile") {
  const std::uint64_t seed = GENERATE(2, 5, 7);
  WorldDef def = shaft(4, seed, 0.6);
  def.method = "exact";
  World world(def);
  run(world);
  CAPTURE(seed, world.report().certificate.max_penetration);
  CHECK(world.report().certificate.max_penetration < 1e-9);
}
