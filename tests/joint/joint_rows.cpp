// Every row of every joint against differences of its gap along a motion.
#include "sim/joint/joint_rows.h"

#include <cmath>
#include <random>

#include "sim/body/mass_properties.h"
#include "sim/math/rotation.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

/// Numbers in [−1, 1], one per statement.
class Draw {
 public:
  explicit Draw(unsigned seed) : source_(seed) {}
  double number() { return 2.0 * (static_cast<double>(source_()) / 4294967295.0) - 1.0; }
  Vec3 vector() {
    const double x = number();
    const double y = number();
    const double z = number();
    return {x, y, z};
  }

 private:
  std::mt19937 source_;
};

RigidBody tumbling(Draw& draw) {
  RigidBody body = makeBody(solidMass(Box{{0.3, 0.5, 0.2}}, 2.0));
  body.x = draw.vector();
  const Vec3 turn = draw.vector();
  body.q = rotated(Quat::Identity(), turn).normalized();
  updateDerived(body);
  const Vec3 v = draw.vector();
  const Vec3 omega = draw.vector();
  setVelocity(body, v, omega);
  return body;
}

/// The body a time t later, at constant accelerations v̇, ω̇: exact to t² in place and turn.
RigidBody later(const RigidBody& body, const Vec6& acceleration, double t) {
  RigidBody moved = body;
  const Vec3 dw = acceleration.tail<3>();
  moved.x += t * body.v + 0.5 * t * t * acceleration.head<3>();
  moved.q = rotated(body.q, t * body.omega + 0.5 * t * t * dw).normalized();
  updateDerived(moved);
  setVelocity(moved, body.v + t * acceleration.head<3>(), body.omega + t * dw);
  return moved;
}

/// A joint between two tumbling bodies that is far from being met.
Joint torn(JointKind kind, std::span<const RigidBody> bodies, Draw& draw, bool toWorld) {
  JointDef def{.kind = kind, .a = 0, .b = toWorld ? -1 : 1};
  def.anchorA = draw.vector();
  def.anchorB = kind == JointKind::Distance ? draw.vector() : def.anchorA;
  def.axis = draw.vector();
  def.lo = -0.7;
  def.hi = 1.1;
  if (kind == JointKind::Distance) def.lo = 0.1;
  std::vector<RigidBody> start(bodies.begin(), bodies.end());
  for (RigidBody& body : start) {  // the pose it is met at: a little off
    const Vec3 shift = draw.vector();
    const Vec3 turn = draw.vector();
    body.x += 0.1 * shift;
    body.q = rotated(body.q, 0.3 * turn).normalized();
    updateDerived(body);
  }
  return makeJoint(def, start, 0.8);
}

}  // namespace

// Oracle: central differences over 2e-5 s of the gap, which are J v, and of its rate, J v̇ + J̇ v:
// truncation t² times third derivatives, which are large where two anchors are near each other.
// Measured 5e-9 and 1.4e-7; allowed 1e-7 and 2e-6.
TEST_CASE("rows of joints are the derivatives of their gaps") {
  constexpr double t = 1e-5;
  Draw draw(7);
  double worstRate = 0.0, worstBend = 0.0;
  int rowsSeen = 0;
  for (const JointName& kind : jointNames())
    for (int trial = 0; trial < 200; ++trial) {
      const RigidBody a = tumbling(draw);
      const RigidBody b = tumbling(draw);
      const std::vector<RigidBody> bodies = {a, b};
      const Joint joint = torn(kind.kind, bodies, draw, trial % 4 == 0);
      Vec6 acceleration[3] = {Vec6::Zero(), Vec6::Zero(), Vec6::Zero()};
      for (int i = 0; i < 2; ++i) {
        const Vec3 dv = draw.vector();
        const Vec3 dw = draw.vector();
        acceleration[i] << dv, dw;
      }
      std::vector<JointRow> now, before, after;
      jointRows(bodies, joint, now);
      const std::vector<RigidBody> back = {later(a, acceleration[0], -t),
                                           later(b, acceleration[1], -t)};
      const std::vector<RigidBody> forth = {later(a, acceleration[0], t),
                                            later(b, acceleration[1], t)};
      jointRows(back, joint, before);
      jointRows(forth, joint, after);
      REQUIRE(now.size() == after.size());
      for (std::size_t k = 0; k < now.size(); ++k) {
        const Row& row = now[k].row;
        const auto along = [&](const Vec6& va, const Vec6& vb) {
          return row.linear.dot(va.head<3>() - vb.head<3>()) + row.angularA.dot(va.tail<3>()) +
                 row.angularB.dot(vb.tail<3>());
        };
        Vec6 va, vb;
        va << a.v, a.omega;
        vb << b.v, b.omega;
        const bool world = row.b == 2;
        if (world) vb.setZero();
        const double slope = (after[k].gap - before[k].gap) / (2.0 * t);
        const double bend = (after[k].rate - before[k].rate) / (2.0 * t);
        CHECK(now[k].rate == Approx(along(va, vb)).margin(1e-13));
        worstRate = std::max(worstRate, std::abs(slope - now[k].rate));
        worstBend = std::max(
            worstBend,
            std::abs(bend - row.bias - along(acceleration[0], acceleration[world ? 2 : 1])));
        ++rowsSeen;
      }
    }
  CAPTURE(worstRate, worstBend);
  CHECK(rowsSeen == 5000);
  CHECK(worstRate < 1e-7);
  CHECK(worstBend < 2e-6);
}

// Oracle: symmetry. Turning and shifting the whole opens nothing. Measured 7e-16.
TEST_CASE("a joint met at the start has no gap, and keeps none while its bodies move as one") {
  Draw draw(11);
  for (const JointName& kind : jointNames()) {
    const std::vector<RigidBody> bodies = {tumbling(draw), tumbling(draw)};
    JointDef def{.kind = kind.kind, .a = 0, .b = 1};
    def.anchorA = def.anchorB = draw.vector();
    if (kind.kind == JointKind::Distance) def.anchorB = draw.vector();
    def.axis = draw.vector();
    const Joint joint[] = {makeJoint(def, bodies, 1.0)};
    CAPTURE(kind.name);
    CHECK(largestJointGap(bodies, joint) < 1e-15);
    // The whole turned and shifted.
    const Vec3 turn = draw.vector();
    const Quat q = rotated(Quat::Identity(), turn).normalized();
    std::vector<RigidBody> moved = bodies;
    for (RigidBody& body : moved) {
      body.x = q * body.x + Vec3(1.0, 2.0, 3.0);
      body.q = q * body.q;
      updateDerived(body);
    }
    CHECK(largestJointGap(moved, joint) < 2e-15);
  }
}

// Oracle: by hand. A hinge's turn is counted from the start, right-handed about its axis.
TEST_CASE("the turn of a hinge is that of a against b") {
  std::vector<RigidBody> bodies = {makeBody(solidMass(Sphere{0.1}, 1.0))};
  updateDerived(bodies[0]);
  JointDef def{.kind = JointKind::Hinge, .a = 0};
  def.axis = Vec3::UnitZ();
  def.lo = -3.0;
  def.hi = 0.1;
  const Joint joint = makeJoint(def, bodies, 1.0);
  def.lo = -0.1;
  def.hi = 3.0;
  const Joint mirrored = makeJoint(def, bodies, 1.0);
  for (double angle : {-3.3, -2.9, -1.0, 0.0, 0.05, 0.3}) {  // the first beyond half a turn
    for (const double sign : {1.0, -1.0}) {
      bodies[0].q = rotated(Quat::Identity(), {0.0, 0.0, sign * angle});
      updateDerived(bodies[0]);
      std::vector<JointRow> rows;
      jointRows(bodies, sign > 0.0 ? joint : mirrored, rows);
      REQUIRE(rows.size() == 7);
      const double lower = rows[sign > 0.0 ? 5 : 6].gap, upper = rows[sign > 0.0 ? 6 : 5].gap;
      CHECK(lower == Approx(angle + 3.0).margin(1e-14));
      CHECK(upper == Approx(0.1 - angle).margin(1e-14));
    }
  }
}
