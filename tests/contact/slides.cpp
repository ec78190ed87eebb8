// The slides on colliding contact as experiments (SD30–SD31, SD36–SD38, SD41–SD46).
#include "sim/body/mass_properties.h"
#include "sim/contact/contact.h"
#include "sim/contact/impulse.h"
#include "sim/math/rotation.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

RigidBody movingSolid(const Shape& shape, double mass, const Vec3& v,
                      const Vec3& omega = Vec3::Zero()) {
  RigidBody body = makeBody(solidMass(shape, mass));
  updateDerived(body);
  setVelocity(body, v, omega);
  return body;
}

ContactPoint at(const Vec3& p, const Vec3& n = Vec3::UnitY()) {
  ContactPoint c;
  c.p = p;
  c.n = n;
  return c;
}

}  // namespace

// Oracle: figures 20 to 23 of the notes, by hand: the point of a falls, stays or rises, on a floor
// that stays, rises or sinks. vrel = 1 − 2, and so on, exactly.
TEST_CASE("colliding, resting or separating is a matter of the relative velocity along n") {
  const auto kind = [](double up, double floorUp) {
    const RigidBody a = movingSolid(Sphere{0.5}, 1.0, {3.0, up, -1.0});
    const RigidBody b = makeFixedBody({}, {0.5, floorUp, 2.0}, Vec3::Zero());
    CHECK(approachVelocity(a, b, at({0.0, -0.5, 0.0})) == up - floorUp);
    return classify(up - floorUp, 1e-9);
  };
  CHECK(kind(-1.0, 0.0) == ContactClass::Colliding);
  CHECK(kind(0.0, 0.0) == ContactClass::Resting);
  CHECK(kind(1.0, 0.0) == ContactClass::Separating);
  CHECK(kind(1.0, 2.0) == ContactClass::Colliding);     // the floor is faster
  CHECK(kind(-1.0, -1.0) == ContactClass::Resting);     // both sink
  CHECK(kind(-1.0, -2.0) == ContactClass::Separating);  // the floor falls away
}

// Oracle: the definition, for every tolerance; a speed of exactly the tolerance rests.
TEST_CASE("the three classes of contact share the line at plus and minus the tolerance") {
  for (double tolerance = 1e-12; tolerance < 1.0; tolerance *= 10.0)
    for (const double share : {-1e3, -1.0001, -1.0, -0.5, 0.0, 0.5, 1.0, 1.0001, 1e3}) {
      CAPTURE(tolerance, share);
      const ContactClass expected = share < -1.0  ? ContactClass::Colliding
                                    : share > 1.0 ? ContactClass::Separating
                                                  : ContactClass::Resting;
      CHECK(classify(share * tolerance, tolerance) == expected);
    }
}

// Oracle: solved by hand. c j + b = d with b = vrel, d = −e vrel, so j = −(1 + e) vrel/c:
//   a ball on the floor, c = 1/m;
//   a thin rod hit at its end, c = 1/m + (l/2)²/(m l²/12) = 4/m;
//   a cube hit at a corner, c = 1/m + (s²/4 + s²/4)/(m s²/6) = 4/m.   Only rounding, 1e-14.
TEST_CASE("c j + b = d against a fixed body is as solved by hand") {
  const RigidBody floor = makeFixedBody({});
  for (const double e : {0.0, 0.5, 1.0}) {
    CAPTURE(e);
    const RigidBody ball = movingSolid(Sphere{0.3}, 2.0, {0.0, -3.0, 0.0});
    CHECK(collisionImpulse(ball, floor, at({0.0, -0.3, 0.0}), e) ==
          Approx((1.0 + e) * 2.0 * 3.0).epsilon(1e-14));

    RigidBody rod = movingSolid(Box{{1.0, 1e-9, 1e-9}}, 3.0, {0.0, -2.0, 0.0});
    const double j = collisionImpulse(rod, floor, at({1.0, 0.0, 0.0}), e);
    CHECK(j == Approx((1.0 + e) * 3.0 * 2.0 / 4.0).epsilon(1e-14));
    // The end leaves at e · 2 m/s; the centre is slowed by a quarter of what a ball would be.
    applyImpulse(rod, {1.0, 0.0, 0.0}, {0.0, j, 0.0});
    CHECK(rod.v.y() == Approx(-2.0 + (1.0 + e) / 2.0).epsilon(1e-14));
    CHECK(rod.omega.z() == Approx((1.0 + e) * 1.5).epsilon(1e-14));

    const RigidBody cube = movingSolid(Box{{0.4, 0.4, 0.4}}, 5.0, {0.0, -1.0, 0.0});
    CHECK(collisionImpulse(cube, floor, at({0.4, -0.4, 0.4}), e) ==
          Approx((1.0 + e) * 5.0 / 4.0).epsilon(1e-14));
  }
}

// Oracle: solved by hand, both bodies moving. Two balls: c = 1/m₁ + 1/m₂; a ball on the end of a
// free rod: c = 1/m₁ + 4/m₂. Only rounding, 1e-14.
TEST_CASE("c j + b = d between two moving bodies is as solved by hand") {
  for (const double e : {0.0, 0.5, 1.0}) {
    CAPTURE(e);
    RigidBody a = movingSolid(Sphere{0.5}, 1.0, {0.0, -2.0, 0.0});
    RigidBody b = movingSolid(Sphere{0.5}, 3.0, {0.0, 1.0, 0.0});
    const double j = collisionImpulse(a, b, at({0.0, 0.0, 0.0}), e);
    CHECK(j == Approx((1.0 + e) * 3.0 / (1.0 + 1.0 / 3.0)).epsilon(1e-14));
    applyImpulse(a, Vec3::Zero(), {0.0, j, 0.0});
    applyImpulse(b, Vec3::Zero(), {0.0, -j, 0.0});
    // e = 1 swaps the velocities relative to the common centre of mass, which moves at 0.25 m/s.
    CHECK(a.v.y() == Approx(0.25 + e * 2.25).epsilon(1e-14));
    CHECK(b.v.y() == Approx(0.25 - e * 0.75).epsilon(1e-14));

    RigidBody ball = movingSolid(Sphere{0.5}, 1.0, {0.0, -2.0, 0.0});
    ball.x = {1.0, 0.5, 0.0};
    const RigidBody rod =
        movingSolid(Box{{1.0, 1e-9, 1e-9}}, 2.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
    // The rod's end rises at ω l/2 = 1 m/s.
    CHECK(collisionImpulse(ball, rod, at({1.0, 0.0, 0.0}), e) ==
          Approx((1.0 + e) * 3.0 / (1.0 + 2.0)).epsilon(1e-14));
  }
}

// Oracle: probing. The relative velocity is linear in j: one unit of impulse changes it by c,
// whatever the bodies do; allowed 1e-13.
TEST_CASE("c is what one unit of impulse changes in the relative velocity") {
  RigidBody a = movingSolid(Box{{0.5, 0.2, 0.3}}, 2.0, {0.3, -0.4, 0.5}, {1.0, -2.0, 0.7});
  RigidBody b = movingSolid(Box{{0.1, 0.6, 0.2}}, 0.7, {-0.6, 0.2, 0.1}, {-1.2, 0.4, 2.0});
  a.q = fromAxisAngle({1.0, 2.0, 0.5}, 0.4);
  b.q = fromAxisAngle({0.2, -1.0, 0.5}, 1.1);
  updateDerived(a);
  updateDerived(b);
  const ContactPoint c = at({0.3, 0.2, -0.1}, Vec3(0.3, 1.0, -0.2).normalized());
  const double k = inverseEffectiveMass(a, b, c.p, c.n);
  double before = approachVelocity(a, b, c);
  for (int n = 0; n < 5; ++n) {
    applyImpulse(a, c.p, c.n);
    applyImpulse(b, c.p, -c.n);
    const double after = approachVelocity(a, b, c);
    CHECK(after - before == Approx(k).epsilon(1e-13));
    before = after;
  }
}
