// Slips that begin, and velocities that are stilled.
#include <cmath>

#include "sim/body/mass_properties.h"
#include "sim/contact/modes.h"
#include "sim/math/rotation.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

/// A brick that stands on one corner at the origin, and a floor.
struct Corner {
  std::vector<RigidBody> bodies;
  std::vector<Contact> contacts = std::vector<Contact>(1);

  explicit Corner(const Vec3& omega) {
    bodies.push_back(makeFixedBody({}));
    RigidBody brick = makeBody(solidMass(Shape(Box{{0.2, 0.1, 0.15}}), 3.0));
    brick.q = fromAxisAngle({1.0, 0.3, -0.6}, 0.7);
    brick.x = brick.q * Vec3(0.2, 0.1, 0.15);
    updateDerived(brick);
    setVelocity(brick, omega.cross(brick.x), omega);
    brick.force = brick.M * Vec3(2.0, -9.81, 1.0);
    bodies.push_back(brick);
    Contact& c = contacts[0];
    c.a = 1;
    c.b = 0;
    c.point.tie = NormalTie::FaceOfB;
    c.point.n = Vec3::UnitY();
    c.friction = 0.2;
    c.sliding = c.lasting = true;
    c.anchor = anchorOf(bodies[1], bodies[0], c.point);
    c.onset = 1e-3;
  }
  /// u̇ [m/s²] under the forces that the modes give.
  Vec3 begin(double angle) {
    contacts[0].slipDirection = fromAxisAngle(Vec3::UnitY(), angle) * Vec3::UnitX();
    ModeForces().apply(bodies, contacts);
    return slipAcceleration(bodies[1], bodies[0], contacts[0].point);
  }
};

}  // namespace

// Oracle: by counting. Three corners of one brick that stick are nine rows of one system, a corner
// of another brick that slides is a row alone.
TEST_CASE("what forces cost is counted by the rows that hang together") {
  Corner corner(Vec3::Zero());
  corner.bodies.push_back(corner.bodies[1]);
  corner.contacts[0].sliding = false;
  corner.contacts[0].onset = 0.0;
  corner.contacts.resize(4, corner.contacts[0]);
  for (int k = 1; k < 3; ++k) corner.contacts[k].point.p = 0.1 * Vec3::Unit(2 * (k - 1));
  corner.contacts[3].a = 2;
  corner.contacts[3].sliding = true;
  corner.contacts[3].slipDirection = Vec3::UnitX();
  ModeForces forces;
  forces.apply(corner.bodies, corner.contacts);
  CHECK(forces.cubes() == 9.0 * 9.0 * 9.0 + 1.0);
}

// Oracle: invariant: the slip begins against its friction. The direction is off by up to 17 degrees
// at first; of that, four secants leave 1.5e-7, allowed 1e-5.
TEST_CASE("a slip that begins grows along the line of its friction") {
  const Vec3 omega(0.3, -0.5, 0.2);
  const Vec3 along = Corner(omega).begin(0.0).normalized();
  const double line = std::atan2(-along.z(), along.x());
  for (const double off : {-0.3, -0.1, 0.0, 0.1, 0.3}) {
    Corner corner(omega);
    const Vec3 rate = corner.begin(line + off);
    const Contact& c = corner.contacts[0];
    const Vec3 friction = c.force - c.force.dot(c.point.n) * c.point.n;
    CAPTURE(off, rate.x(), rate.z(), c.growth.cross(rate).norm() / rate.norm());
    CHECK(rate.dot(c.growth) > 0.0);
    CHECK(c.growth.cross(rate).norm() < 1e-5 * rate.norm());
    CHECK((friction + c.friction * c.force.dot(c.point.n) * c.growth).norm() <
          1e-12 * c.force.norm());
  }
}

// Oracle: closed form: below its onset the direction is a mean, at its onset that of the slip.
TEST_CASE("as a slip grows beyond its onset, its friction turns against the slip itself") {
  for (const double part : {0.0, 0.25, 0.5, 0.999, 1.0, 3.0}) {
    Corner corner(Vec3::Zero());
    Contact& c = corner.contacts[0];
    c.growth = Vec3::UnitX();
    c.slipDirection = Vec3(1.0, 0.0, 0.3).normalized();
    RigidBody& brick = corner.bodies[1];
    const Vec3 slip = part * c.onset * Vec3(0.8, 0.0, 0.6);
    setVelocity(brick, slip, Vec3::Zero());
    const Vec3 mean = (1.0 - part) * Vec3::UnitX() + part * Vec3(0.8, 0.0, 0.6);
    const Vec3 expected = part < 1.0 ? Vec3(mean.normalized()) : Vec3(0.8, 0.0, 0.6);
    CAPTURE(part);
    CHECK((slipDirectionOf(brick, corner.bodies[0], c) - expected).norm() < 1e-12);
  }
}

// Oracle: invariants: no contact of a face moves along its normal, the momentum is what the
// impulses gave, and what is not along the normals stays. Measured 3e-16, allowed 1e-13.
TEST_CASE("contacts, more than needed, are stilled along their normals by the least impulses") {
  std::vector<RigidBody> bodies = {makeFixedBody({}),
                                   makeBody(solidMass(Shape(Box{{0.2, 0.1, 0.15}}), 3.0))};
  RigidBody& brick = bodies[1];
  updateDerived(brick);
  setVelocity(brick, {0.4, -0.3, 0.1}, {0.2, 0.7, -0.5});
  std::vector<Contact> contacts;
  for (const double x : {-0.2, 0.2})
    for (const double z : {-0.15, 0.15}) {
      Contact c;
      c.a = 1;
      c.point.n = Vec3::UnitY();
      c.point.p = c.point.pa = c.point.pb = Vec3(x, -0.1, z);
      contacts.push_back(c);
    }
  const Vec3 before = brick.P;
  Vec3 given = Vec3::Zero();
  for (const Vec3& J : ModeForces().still(bodies, contacts)) given += J;
  for (const Contact& c : contacts)
    CHECK(std::abs(approachVelocity(brick, bodies[0], c.point)) < 1e-13);
  CHECK((brick.P - before - given).norm() < 1e-13);
  CHECK((brick.v - Vec3(0.4, 0.0, 0.1)).norm() < 1e-13);
  CHECK((brick.omega - Vec3(0.0, 0.7, 0.0)).norm() < 1e-13);
}
