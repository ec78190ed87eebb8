// Chapter 11: worlds that go on from a sample of another run.
#include <cmath>

#include "sim/world.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

BodyDef rod(const std::string& name, const Vec3& x) {
  return {.name = name, .shape = Box{{0.25, 0.02, 0.03}}, .mass = 1.0, .position = x};
}

WorldDef doublePendulum() {
  WorldDef def;
  def.method = "stepping";
  def.bodies = {rod("a", {0.25, 2.0, 0.0}), rod("b", {0.75, 2.0, 0.0})};
  JointDef top{.kind = JointKind::Hinge, .a = 0, .b = kNoBody, .anchorA = {0.0, 2.0, 0.0}};
  top.anchorB = top.anchorA;
  top.axis = Vec3::UnitZ();
  JointDef knee{.kind = JointKind::Ball, .a = 0, .b = 1, .anchorA = {0.5, 2.0, 0.0}};
  knee.anchorB = knee.anchorA;
  def.joints = {top, knee};
  return def;
}

WorldDef onSpring() {
  WorldDef def;
  def.method = "stepping";
  def.bodies = {rod("a", {0.0, 1.0, 0.0})};
  def.bodies[0].angularVelocity = {1.0, 2.0, 3.0};
  def.forces.push_back(Spring{.a = 0,
                              .anchorA_B = {0.25, 0.0, 0.0},
                              .anchorB_B = {0.25, 2.0, 0.0},
                              .stiffness = 100.0,
                              .damping = 0.5,
                              .rest = 0.8});
  return def;
}

WorldDef top() {
  WorldDef def;
  def.method = "course";
  def.bodies = {{.name = "top", .shape = Cylinder{0.1, 0.05}, .mass = 1.0}};
  def.bodies[0].position = {0.0, 1.0, 0.0};
  def.bodies[0].orientation = Quat(Eigen::AngleAxisd(0.4, Vec3::UnitZ()));
  def.bodies[0].angularVelocity = def.bodies[0].orientation * Vec3(0.0, 60.0, 0.0);
  def.bodies[0].pivot_B = Vec3(0.0, -0.2, 0.0);
  return def;
}

WorldDef sliding() {
  WorldDef def;
  def.method = "stepping";
  def.bodies = {{.name = "floor", .shape = HalfSpace{Vec3::UnitY(), 0.0}, .fixed = true},
                {.name = "box", .shape = Box{{0.2, 0.1, 0.3}}, .mass = 3.0}};
  for (BodyDef& body : def.bodies) body.friction = 0.2;
  def.bodies[1].position = {0.0, 0.1, 0.0};
  def.bodies[1].velocity = {2.0, 0.0, 0.0};
  return def;
}

double furthest(const Sample& a, const Sample& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    most = std::max(most, (a.bodies[i].x - b.bodies[i].x).norm());
    most = std::max(most, a.bodies[i].q.angularDistance(b.bodies[i].q));
  }
  return most;
}

}  // namespace

// Oracle: the run that was not left. Measured [m, rad]: pendulum 4.8e-15, spring 1.5e-13, top
// 1.6e-13, sliding 3.3e-18.
TEST_CASE("a world that goes on from a sample moves as the one that it was taken from") {
  const double half = 0.5;  // s: whole steps
  for (const WorldDef& def : {doublePendulum(), onSpring(), top(), sliding()}) {
    World whole(def);
    whole.advance(half);
    const Sample left = whole.sample(half);
    whole.advance(2.0 * half);
    World again(def, left);
    again.advance(half);
    const double apart = furthest(whole.sample(2.0 * half), again.sample(half));
    INFO(def.bodies[0].name << " apart by " << apart);
    CHECK(furthest(whole.sample(2.0 * half), left) > 0.05);
    CHECK(apart < 1e-11);
  }
}

TEST_CASE("a world goes on from samples of its own bodies alone") {
  const World two(doublePendulum());
  CHECK_THROWS_AS(World(top(), two.sample(0.0)), std::invalid_argument);
}
