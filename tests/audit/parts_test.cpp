// What the audit is made of, each against another way to the same number.
#include <cmath>

#include "sim/audit/depth.h"
#include "sim/audit/joint_gap.h"
#include "sim/collide/collide.h"
#include "sim/flight/flight.h"
#include "sim/joint/joint_rows.h"
#include "tests/catch.h"
#include "tests/collide/random_pose.h"
#include "tests/problem/problems.h"
#include "tests/world/joints.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

Quat turned(test::Draw& draw) {
  const double w = draw(-1.0, 1.0), x = draw(-1.0, 1.0), y = draw(-1.0, 1.0), z = draw(-1.0, 1.0);
  return Quat(w, x, y, z).normalized();
}

}  // namespace

// Oracle: the exact rotor. The turn half-way through a part is off by h⁴; measured 16.2. It says
// itself that it may be off by more.
TEST_CASE("the audit's way between two states is off by the fourth power of the step") {
  BodyDef def = box("brick", {0.3, 0.1, 0.2}, Vec3::Zero());
  RigidBody body = makeBody(massOf(def));
  setVelocity(body, {1.0, 0.0, 0.0}, {2.0, 3.0, 1.0});
  const Flight flight(body, {0.0, -9.81, 0.0}, 0.0);
  const auto error = [&](double h) {
    RigidBody end = body, middle = body;
    flight.at(h, end);
    flight.at(0.5 * h, middle);
    const BodyPath path(body, recordedOf(body), recordedOf(end), h, false);
    const PathPoint point = path.at(0.5);
    const double off = point.q.angularDistance(middle.q);
    CHECK((point.x - middle.x).norm() < 1e-14);
    CHECK(path.error(0.5, 1.0) > off);
    CHECK(path.error(0.5, 1.0) < 100.0 * off);
    return off;
  };
  const double coarse = error(0.08), fine = error(0.04);
  CAPTURE(coarse, fine);
  CHECK(coarse < 1e-4);
  CHECK(fine < coarse / 12.0);
}

// Oracle: closed forms. A body turns about an edge by φ = 0.4 cosh 10 t, and its centre goes around
// it: as it turns back at t = 0, the third terms of the series are gone there. Measured
// 1.4e-5 m off; it says 1.3 times as much. Of a free fall, which is a parabola, it says rounding.
TEST_CASE("the audit's way knows how far it is off where a body turns back") {
  const double h = 0.04, rate = 10.0, most = 0.4, far = 0.2;
  RigidBody body = makeBody(massOf(box("brick", {0.2, 0.2, 0.2}, Vec3::Zero())));
  const auto tipped = [&](double t) {
    const double phi = most * std::cosh(rate * t), spin = most * rate * std::sinh(rate * t);
    RigidBody now = body;
    now.x = far * Vec3(-std::sin(phi), std::cos(phi), 0.0);
    now.q = Quat(Eigen::AngleAxisd(phi, Vec3::UnitZ()));
    updateDerived(now);
    setVelocity(now, spin * Vec3::UnitZ().cross(now.x), spin * Vec3::UnitZ());
    return now;
  };
  const BodyPath path(body, recordedOf(tipped(-0.5 * h)), recordedOf(tipped(0.5 * h)), h, false);
  const PathPoint point = path.at(0.5);
  const RigidBody middle = tipped(0.0);
  const double off =
      (point.x - middle.x).norm() + far * point.q.angularDistance(middle.q);  // at the edge
  CAPTURE(off, path.error(0.5, far));
  CHECK(off > 1e-6);
  CHECK(path.error(0.5, far) > off);
  CHECK(path.error(0.5, far) < 20.0 * off);

  setVelocity(body, {3.0, 0.0, 0.0}, Vec3::Zero());
  RigidBody end = body;
  Flight(body, {0.0, -9.81, 0.0}, 0.0).at(1.0, end);
  CHECK(BodyPath(body, recordedOf(body), recordedOf(end), 1.0, false).error(0.5, far) < 1e-14);
}

// Oracle: `collide`, which finds its gap by features; the audit's by how far solids reach. A gap
// that is proved is never wider than the widest, and for solids that overlap no less by rounding.
TEST_CASE("the gap that a plane proves is the one that collide finds") {
  test::Draw draw(3);
  const Shape shapes[] = {Sphere{0.2}, Box{{0.2, 0.1, 0.15}}, Capsule{0.1, 0.3},
                          Cylinder{0.15, 0.2}};
  int deep = 0;
  for (int k = 0; k < 2000; ++k) {
    const Shape &a = shapes[draw.below(4)], &b = shapes[draw.below(4)];
    const double x = draw(-0.3, 0.3), y = draw(-0.3, 0.3), z = draw(-0.3, 0.3);
    const Pose poseA{{x, y, z}, turned(draw)}, poseB{Vec3::Zero(), turned(draw)};
    const double found = separation(a, poseA, b, poseB);
    const double proven = provenGap(convexParts(a), poseA, convexParts(b), poseB);
    CAPTURE(k, shapeName(a), shapeName(b), found, proven);
    if (found >= 0.0) continue;
    ++deep;
    const bool round = std::holds_alternative<Cylinder>(a) || std::holds_alternative<Cylinder>(b);
    CHECK(proven == Approx(found).margin(round ? 1e-3 : 1e-12));
  }
  CHECK(deep > 300);
}

// Oracle: `largestJointGap`, which takes the gap of a joint row by row: up to √3 times less.
TEST_CASE("a joint that is pulled apart gapes as its rows say") {
  test::Draw draw(5);
  for (const JointName& row : jointNames()) {
    WorldDef def = worldOf("course", 1.0, {});
    def.bodies.push_back(box("a", {0.4, 0.1, 0.1}, {0.2, 0.0, 0.0}));
    def.bodies.push_back(box("b", {0.4, 0.1, 0.1}, {-0.2, 0.0, 0.0}));
    const bool apart = row.kind == JointKind::Distance;
    def.joints.push_back({.name = "j",
                          .kind = row.kind,
                          .a = 0,
                          .b = 1,
                          .anchorA = Vec3::Zero(),
                          .anchorB = apart ? Vec3(-0.3, 0.1, 0.0) : Vec3(Vec3::Zero())});
    const World world(def);
    std::vector<RigidBody> bodies;
    std::vector<Recorded> states;
    for (const BodyDef& body : def.bodies) {
      bodies.push_back(makeBody(massOf(body)));
      bodies.back().x = body.position;
      states.push_back(recordedOf(bodies.back()));
    }
    const Bond bond(world.model(), 0, states);
    CHECK(bond.gap(states) < 1e-15);
    for (int k = 0; k < 20; ++k) {
      const double x = draw(-1e-3, 1e-3), y = draw(-1e-3, 1e-3), w = draw(-1e-3, 1e-3);
      bodies[0].x = def.bodies[0].position + Vec3(x, y, w);
      bodies[0].q = Quat(1.0, y, w, x).normalized();
      updateDerived(bodies[0]);
      states[0] = recordedOf(bodies[0]);
      const double rows = largestJointGap(bodies, world.model().joints), own = bond.gap(states);
      CAPTURE(row.name, rows, own);
      CHECK(own >= 0.999 * rows);
      CHECK(own <= 1.8 * rows);
    }
  }
}
