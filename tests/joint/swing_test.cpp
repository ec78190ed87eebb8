// How fast what joints hold can swing: closed forms of hanging bodies.
#include "sim/joint/swing.h"

#include <cmath>

#include "tests/allocations.h"
#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

/// The fastest swing of a scene at rest, from the forces of its joints. Looked for once more it is
/// the same, and found in the memory that is there.
double fastestOf(WorldDef def) {
  def.method = "stepping";
  World world(def);
  world.advance(def.stepping.step);
  const std::vector<JointForce> forces = world.sample(0.0).joints;
  std::vector<RigidBody> bodies;
  for (const BodyDef& body : def.bodies) {
    bodies.push_back(makeBody(massOf(body)));
    bodies.back().x = body.position;
    updateDerived(bodies.back());
  }
  SwingWork work;
  const auto find = [&] {
    Swing last;
    return fastestSwing(bodies, world.model().joints, forces, *findSolver("newton"), 0.0, last,
                        work);
  };
  const double fastest = find();
  const long before = test::allocations;
  CHECK(find() == fastest);
  CHECK(test::allocations == before);
  return fastest;
}

JointDef pinned(JointKind kind, int a, int b, const Vec3& top) {
  return {.name = "pin", .kind = kind, .a = a, .b = b, .anchorA = top, .anchorB = top};
}

}  // namespace

// Oracle: closed form of small swings, ω² = m g d/(I + m d²). Measured 4e-12 by a hinge,
// 7e-3 too low by a ball, whose two swings are near each other; allowed 1e-2.
TEST_CASE("a hanging body swings as a physical pendulum") {
  const Vec3 edges(0.2, 1.0, 0.3);
  for (const JointKind kind : {JointKind::Hinge, JointKind::Ball}) {
    WorldDef def = worldOf("stepping", 1.0, {box("bar", edges, Vec3::Zero())});
    def.joints = {pinned(kind, 0, kNoBody, {0.0, 0.4, 0.0})};
    // A hinge along z; a ball also lets it swing about x, where it is slower.
    const double about_z = (0.2 * 0.2 + 1.0) / 12.0 + 0.4 * 0.4;
    CHECK(fastestOf(def) == Approx(std::sqrt(9.81 * 0.4 / about_z)).epsilon(1e-2));
  }
}

// Oracle: closed form. A light ball between two rods under a heavy one swings across them with
// ω² = (T₁/l₁ + T₂/l₂)/m, as far as the heavy one stands still. Measured 7e-5, allowed 1e-2.
TEST_CASE("a light body on a taut line swings as a bead on a string") {
  const double heavy = 1000.0, l1 = 0.4, l2 = 0.7;
  WorldDef def =
      worldOf("stepping", 1.0,
              {ball("bead", 0.05, {0.0, -l1, 0.0}), ball("end", 0.1, {0.0, -l1 - l2, 0.0})});
  def.bodies[1].mass = heavy;
  JointDef upper = pinned(JointKind::Distance, 0, kNoBody, {0.0, -l1, 0.0});
  upper.anchorB = Vec3::Zero();
  JointDef lower = pinned(JointKind::Distance, 1, 0, {0.0, -l1 - l2, 0.0});
  lower.anchorB = {0.0, -l1, 0.0};
  def.joints = {upper, lower};
  const double T2 = heavy * 9.81, T1 = T2 + 9.81;
  CHECK(fastestOf(def) == Approx(std::sqrt(T1 / l1 + T2 / l2)).epsilon(1e-2));
}
