// Clusters: what hits within a step goes by a clock of its own, and changes nothing of the rest.
#include <cmath>

#include "sim/collide/collide.h"
#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

// Oracle: bit-equal rerun. What bounces 30 m away divides its own steps, and what rests 50 m away
// makes no contact rougher: a brick that tumbles, a ball in a row of bounces and a pair at rest go
// on as without them, bit by bit. Without restitution a tower far away changes nothing either,
// though it touches at more points than reflections are for.
TEST_CASE("stepping: a body far away changes no bit of the motion of another") {
  const double e = GENERATE(0.5, 0.0);
  const std::string_view preset = GENERATE("draft", "fast", "balanced", "exact");
  const auto with = [&](bool others) {
    BodyDef brick = box("brick", {0.3, 0.2, 0.2}, {0.0, 0.7, 0.0}, e, 0.5);
    brick.orientation = Quat(1.0, 0.2, 0.1, 0.3).normalized();
    WorldDef def = worldOf("stepping", 1.0,
                           {ground(e, 0.5), brick, ball("ball", 0.1, {2.0, 0.4, 0.0}, e),
                            box("below", {0.4, 0.4, 0.4}, {-3.0, 0.2, 0.0}, e, 0.5),
                            box("above", {0.4, 0.4, 0.4}, {-3.0, 0.6, 0.0}, e, 0.5)});
    def.stepping.take(*findSolverPreset(preset));
    if (others) {
      def.bodies.push_back(ball("far", 0.1, {30.0, 0.31, 0.0}, e));
      def.bodies.push_back(ball("farther", 0.1, {30.0, 0.71, 0.01}, e));
      def.bodies.push_back(box("farthest", {0.3, 0.2, 0.2}, {0.0, 0.35, 30.0}, e, 0.5));
      addColumn(def, 6, 0.2, {50.0, 0.1, 0.0}, e, 0.5);
    }
    return def;
  };
  const WorldDef alone = with(false), together = with(true);
  World one(alone), other(together);
  for (int k = 1; k <= 60; ++k) {
    const double t = k / 60.0;
    one.advance(t);
    other.advance(t);
    const Sample p = one.sample(t), q = other.sample(t);
    for (std::size_t i = 0; i < alone.bodies.size(); ++i) {
      CAPTURE(e, preset, t, alone.bodies[i].name);
      CHECK(p.bodies[i].x == q.bodies[i].x);
      CHECK(p.bodies[i].q.coeffs() == q.bodies[i].q.coeffs());
      CHECK(p.bodies[i].v == q.bodies[i].v);
      CHECK(p.bodies[i].omega == q.bodies[i].omega);
    }
  }
}

// Oracle: bit-equal rerun. Two balls rattle between two walls 30 m away: a wall throws one into the
// other, which was not in its way, and the step begins again for them. A brick that tumbles on the
// ground ends it as it did: gone through again, it was up to 7e-14 m aside.
TEST_CASE("stepping: what meets far away begins no step of another again") {
  const auto with = [](bool others) {
    BodyDef brick = box("brick", {0.3, 0.2, 0.2}, {0.0, 0.5, 0.0}, 0.8, 0.5);
    brick.orientation = Quat(1.0, 0.2, 0.1, 0.3).normalized();
    brick.angularVelocity = {1.0, 3.0, 2.0};
    WorldDef def = worldOf(
        "stepping", 1.0, {ground(0.8, 0.5), brick, box("rests", {0.2, 0.2, 0.2}, {5.0, 0.1, 0.0})});
    if (!others) return def;
    constexpr double kRadius = 0.1, kSlack = 0.01, kFar = 30.0, kSpeed = 10.0, kWall = 0.2;
    for (const double side : {-1.0, 1.0}) {
      const double wall = kFar + side * (0.5 * kWall + 2.0 * kRadius + kSlack);
      def.bodies.push_back(box("wall", {kWall, kWall, kWall}, {wall, kRadius, 0.0}, 1.0));
      def.bodies.back().fixed = true;
      def.bodies.push_back(ball("ball", kRadius, {kFar + side * kRadius, kRadius, 0.0}, 1.0));
      def.bodies.back().velocity = {side > 0.0 ? kSpeed : 0.0, 0.0, 0.0};
    }
    return def;
  };
  World alone(with(false)), together(with(true));
  for (int k = 1; k <= 60; ++k) {
    const double t = k / 60.0;
    alone.advance(t);
    together.advance(t);
    const BodySample p = alone.sample(t).bodies[1], q = together.sample(t).bodies[1];
    CAPTURE(t);
    CHECK(p.x == q.x);
    CHECK(p.q.coeffs() == q.q.coeffs());
    CHECK(p.v == q.v);
    CHECK(p.omega == q.omega);
  }
}

// Oracle: bodies do not overlap, by a look at the end of the step. A post that stands is hit at its
// side; above its cap a bar swings about its middle, whose nearest point hardly moves while what is
// farther along it comes down. The two were foreseen to stay apart by the nearest point alone, and
// ended 2.9e-3 m deep. Measured 2.1e-13 m.
TEST_CASE("stepping: what a hit parts from the rest of a step meets what swings over it") {
  constexpr double kRadius = 0.1, kHeight = 0.4, kGap = 2.55e-3, kTilt = -88.2, kStep = 1.0 / 240.0;
  const auto rod = [](const char* name, double height, const Vec3& at) {
    BodyDef body = box(name, Vec3::Zero(), at, 0.5);
    body.shape = Cylinder{kRadius, height};
    return body;
  };
  BodyDef hits = ball("ball", 0.05, {-0.1501, 0.5 * kHeight, 0.0}, 0.5);
  hits.velocity = {0.05, 0.0, 0.0};
  BodyDef bar = rod("bar", 1.2, {-kRadius, kHeight + kRadius + kGap, 0.0});
  bar.orientation = Quat(Eigen::AngleAxisd(kTilt * kPi / 180.0, Vec3::UnitZ()));
  bar.angularVelocity = {0.0, 0.0, -14.0};
  WorldDef def =
      worldOf("stepping", kStep,
              {ground(0.5, 0.0), rod("post", kHeight, {0.0, 0.5 * kHeight, 0.0}), hits, bar});
  def.gravity.setZero();
  def.stepping.step = kStep;
  World world(def);
  world.advance(kStep);
  const std::vector<BodySample> at = world.sample(kStep).bodies;
  const auto pose = [&](int i) { return Pose{at[i].x, at[i].q}; };
  CHECK(separation(def.bodies[1].shape, pose(1), def.bodies[3].shape, pose(3)) >= -1e-12);
}

// Oracle: bit-equal rerun. What stands 50 m away makes no contact rougher. Where tolerances grew
// with the distance of the farthest body, the brick of `exact` ended 3e-11 m aside; where they grew
// with the size of what is fixed, a wall of 20 m moved that of `stepping` by 1e-10 m.
TEST_CASE("a body that stands far away changes no bit of the motion of another, by any method") {
  const double far = GENERATE(0.2, 20.0);  // [m] its edges
  for (const char* method : {"course", "exact", "stepping"}) {
    BodyDef brick = box("brick", {0.3, 0.2, 0.2}, {0.0, 0.7, 0.0}, 0.5, 0.5);
    brick.orientation = Quat(1.0, 0.2, 0.1, 0.3).normalized();
    const WorldDef alone = worldOf(method, 1.0, {ground(0.5, 0.5), brick});
    WorldDef together = alone;
    together.bodies.push_back(box("far", {far, far, far}, {50.0, 0.5 * far, 0.0}, 0.5, 0.5));
    together.bodies.back().fixed = true;
    World one(alone), other(together);
    for (World* world : {&one, &other}) world->advance(1.0);
    CAPTURE(method);
    const BodySample p = one.sample(1.0).bodies[1], q = other.sample(1.0).bodies[1];
    CHECK(p.x == q.x);
    CHECK(p.q.coeffs() == q.q.coeffs());
    CHECK(p.v == q.v);
    CHECK(p.omega == q.omega);
  }
}

// Oracle: bit-equal rerun. What joints, springs and drag hold swings, lies on a board and sinks as
// without balls that bounce 20 m away, which divide their own steps; and they bounce as without it.
TEST_CASE("stepping: what is tied and what bounces elsewhere change no bit of each other") {
  const auto with = [](bool tied, bool bouncing) {
    WorldDef def = worldOf("stepping", 1.0, {ground(0.5, 0.5)});
    if (bouncing) {
      BodyDef brick = box("brick", {0.3, 0.2, 0.2}, {6.0, 0.7, 0.0}, 0.5, 0.5);
      brick.orientation = Quat(1.0, 0.2, 0.1, 0.3).normalized();
      def.bodies.push_back(brick);
      def.bodies.push_back(ball("ball", 0.1, {8.0, 0.4, 0.0}, 0.5));
      def.bodies.push_back(ball("on ball", 0.1, {8.0, 0.7, 0.01}, 0.5));
    }
    if (!tied) return def;
    const int first = static_cast<int>(def.bodies.size());
    def.bodies.push_back(ball("bob", 0.1, {1.0, 2.0, 0.0}));
    def.bodies.push_back(ball("on spring", 0.1, {3.0, 2.0, 0.0}));
    def.bodies.push_back(ball("in oil", 0.1, {5.0, 6.0, 0.0}));
    def.bodies.push_back(box("board", {0.3, 0.05, 0.2}, {-2.0, 0.125, 0.0}, 0.0, 0.5));
    def.bodies.push_back(box("on board", {0.1, 0.1, 0.1}, {-2.0, 0.2, 0.0}, 0.0, 0.5));
    def.bodies.push_back(box("slab", {0.3, 0.1, 0.2}, {-2.0, 0.05, 0.0}, 0.0, 0.5));
    def.bodies.back().fixed = true;
    def.joints = {
        JointDef{.name = "arm", .a = first, .anchorA = {0.0, 2.0, 0.0}, .anchorB = {0.0, 2.0, 0.0}},
        JointDef{.name = "pin",
                 .a = first + 3,
                 .anchorA = {-2.15, 0.1, 0.0},
                 .anchorB = {-2.15, 0.1, 0.0}}};
    def.forces = {Spring{.a = first + 1,
                         .anchorB_B = {3.0, 3.0, 0.5},
                         .stiffness = 200.0,
                         .damping = 0.5,
                         .rest = 0.8},
                  LinearDrag{.body = first + 2, .linear = 0.7}};
    return def;
  };
  World all(with(true, true)), ties(with(true, false)), hits(with(false, true));
  // Worlds that count from one place: see originOf.
  for (const World* world : {&all, &ties, &hits}) REQUIRE(world->origin() == Vec3::Zero());
  const auto sameAs = [&](const World& other, std::size_t from, double t) {
    const Sample p = all.sample(t), q = other.sample(t);
    for (std::size_t i = 1; i < q.bodies.size(); ++i) {
      CAPTURE(t, i);
      CHECK(p.bodies[from + i].x == q.bodies[i].x);
      CHECK(p.bodies[from + i].q.coeffs() == q.bodies[i].q.coeffs());
      CHECK(p.bodies[from + i].v == q.bodies[i].v);
      CHECK(p.bodies[from + i].omega == q.bodies[i].omega);
    }
  };
  for (int k = 1; k <= 60; ++k) {
    const double t = k / 60.0;
    for (World* world : {&all, &ties, &hits}) world->advance(t);
    sameAs(ties, 3, t);
    sameAs(hits, 0, t);
  }
  CHECK(all.report().certificate.steps > ties.report().certificate.steps);
  CHECK(all.report().disagreements.empty());
}
