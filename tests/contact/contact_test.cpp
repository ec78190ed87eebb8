// Contacts: how they are told apart, how their normals turn, how the course's impulse acts.
#include "sim/contact/contact.h"

#include <random>

#include "sim/body/mass_properties.h"
#include "sim/collide/collide.h"
#include "sim/contact/impulse.h"
#include "sim/math/rotation.h"
#include "tests/catch.h"
#include "tests/contact/coasted.h"
#include "tests/world/draws.h"

using namespace tumble;

namespace {

RigidBody movingBox(const Vec3& x, const Vec3& axis, double angle, const Vec3& v, const Vec3& w) {
  RigidBody body = makeBody(solidMass(Box{{0.5, 0.2, 0.3}}, 2.0));
  body.x = x;
  body.q = fromAxisAngle(axis, angle);
  updateDerived(body);
  setVelocity(body, v, w);
  return body;
}

Contact contactOf(NormalTie tie, const RigidBody& a, const RigidBody& b, bool roundEdges = false) {
  Contact c;
  ContactPoint& p = c.point;
  p.tie = tie;
  p.n = Vec3(0.2, 1.0, -0.1).normalized();
  p.separation = tie == NormalTie::Edges ? 0.0 : 0.01;
  const bool roundA =
      tie == NormalTie::Points || tie == NormalTie::EdgeOfB || tie == NormalTie::FaceOfB;
  const bool roundB =
      tie == NormalTie::Points || tie == NormalTie::EdgeOfA || tie == NormalTie::FaceOfA;
  p.ra = roundA || roundEdges ? 0.3 : 0.0;
  p.rb = roundB || roundEdges ? 0.2 : 0.0;
  p.pb = b.x + Vec3(0.1, 0.3, -0.2);
  p.pa = p.pb + (p.separation + p.ra + p.rb) * p.n;
  p.p = 0.5 * ((p.pa - p.ra * p.n) + (p.pb + p.rb * p.n));
  // Edges lie across the normal.
  p.ea = Vec3(1.0, 0.1, 0.4).cross(p.n).normalized();
  p.eb = Vec3(-0.3, 0.2, 1.0).cross(p.n).normalized();
  if (tie == NormalTie::Edges && p.ea.cross(p.eb).dot(p.n) < 0.0) p.eb = -p.eb;
  c.anchor = anchorOf(a, b, p);
  return c;
}

struct Tie {
  NormalTie tie;
  bool roundEdges = false;  ///< as those of capsules
  bool crosses = false;     ///< two edges, of which one may be the axis of a cylinder
};
constexpr Tie kTies[] = {{NormalTie::FaceOfB},
                         {NormalTie::FaceOfA},
                         {NormalTie::Points},
                         {NormalTie::EdgeOfB},
                         {NormalTie::EdgeOfA},
                         {NormalTie::Edges},
                         {NormalTie::Edges, true},
                         {NormalTie::FaceOfB, false, true},
                         {NormalTie::FaceOfA, false, true}};

}  // namespace

TEST_CASE("a contact is colliding, resting or separating by the sign of vrel") {
  CHECK(classify(-1e-3, 1e-6) == ContactClass::Colliding);
  CHECK(classify(-1e-9, 1e-6) == ContactClass::Resting);
  CHECK(classify(1e-9, 1e-6) == ContactClass::Resting);
  CHECK(classify(1e-3, 1e-6) == ContactClass::Separating);
}

// Oracle: central differences of the followed features; h = 1e-4 s leaves h² times third
// derivatives of order 100: measured 3e-7 and 2e-6, allowed ten times that.
TEST_CASE("the normal, the gap and its second derivative follow the features they are tied to") {
  for (const auto& [tie, roundEdges, crosses] : kTies) {
    CAPTURE(static_cast<int>(tie), roundEdges, crosses);
    const RigidBody b =
        movingBox({0.1, 0.0, 0.2}, {1, 2, 0.5}, 0.4, {0.3, -0.4, 0.5}, {1.0, -2.0, 0.7});
    RigidBody a =
        movingBox({0.2, 0.9, 0.1}, {0.2, -1, 0.5}, 1.1, {-0.6, 0.2, 0.1}, {-1.2, 0.4, 2.0});
    Contact c = contactOf(tie, a, b, roundEdges);
    c.point.crosses = crosses;
    if (crosses)  // a line that lies on the face goes on to lie on it
      setVelocity(
          a, a.v,
          b.omega + 1.3 * c.point.n + 0.8 * (tie == NormalTie::FaceOfB ? c.point.ea : c.point.eb));
    const double h = 1e-4;
    Contact before = c, after = c, now = c;
    follow(coasted(a, -h), coasted(b, -h), before);
    follow(coasted(a, h), coasted(b, h), after);
    follow(a, b, now);
    CHECK((now.point.n - c.point.n).norm() < 1e-14);
    CHECK(now.point.separation == Approx(c.point.separation).margin(1e-14));

    const Vec3 rate = (after.point.n - before.point.n) / (2.0 * h);
    CHECK((rate - normalRate(a, b, c.point)).norm() < 3e-6);
    const double speed = (after.point.separation - before.point.separation) / (2.0 * h);
    CHECK(speed == Approx(approachVelocity(a, b, c.point)).margin(1e-6));
    const double bend =
        (after.point.separation - 2.0 * now.point.separation + before.point.separation) / (h * h);
    CHECK(bend == Approx(normalAccelerationBias(a, b, c.point)).margin(2e-5));
    const Vec3 place = (after.point.p - before.point.p) / (2.0 * h);
    const Vec3 expected = placeVelocity(a, b, c.point);
    // The place is tracked on the surfaces; along n it may differ by the speed of the gap.
    const Vec3 difference = place - expected;
    CHECK((difference - difference.dot(c.point.n) * c.point.n).norm() <
          2e-2 * c.point.separation * 1e2 + 1e-5);
  }
}

// Oracle: the same contact. An integrator tries poses far away; two that turn by 80 degrees and one
// that comes back at once turn n by more than it could be told by.
TEST_CASE("a contact of round edges is the same wherever it was followed before") {
  const RigidBody b = movingBox({0.1, 0.0, 0.2}, {1, 2, 0.5}, 0.4, Vec3::Zero(), Vec3::Zero());
  const RigidBody a = movingBox({0.2, 0.9, 0.1}, {0.2, -1, 0.5}, 1.1, Vec3::Zero(), Vec3::Zero());
  const Contact c = contactOf(NormalTie::Edges, a, b, true);
  Contact tried = c;
  for (const double degrees : {80.0, 160.0, 0.0}) {
    const Quat turn = fromAxisAngle({0.0, 0.0, 1.0}, degrees * EIGEN_PI / 180.0);
    RigidBody turnedA = a, turnedB = b;
    for (RigidBody* body : {&turnedA, &turnedB}) {
      body->x = turn * body->x;
      body->q = turn * body->q;
      updateDerived(*body);
    }
    follow(turnedA, turnedB, tried);
    CHECK((tried.point.n - turn * c.point.n).norm() < 1e-14);
    CHECK(tried.point.separation == Approx(c.point.separation).margin(1e-14));
  }
}

// Oracle: closed form. A turn about n leaves n and the gap, also where edges come to lie along each
// other, and cross nowhere: a capsule that settled on two others had no energy that was a number.
// Measured 2e-16, and 1.3e-16 m of the gap.
TEST_CASE("edges that come to lie along each other keep their normal, and move at numbers") {
  const RigidBody b = movingBox({0.1, 0.0, 0.2}, {1, 2, 0.5}, 0.4, {0.3, -0.4, 0.5}, {1, -2, 0.7});
  const RigidBody a = movingBox({0.2, 0.9, 0.1}, {0.2, -1, 0.5}, 1.1, {-0.6, 0, 0.1}, {-1, 0.4, 2});
  double turned = 0.0, gap = 0.0;
  for (const bool roundEdges : {true, false}) {
    const Contact c = contactOf(NormalTie::Edges, a, b, roundEdges);
    const double angle =
        std::atan2(c.point.ea.cross(c.point.eb).dot(c.point.n), c.point.ea.dot(c.point.eb));
    for (const double off : {0.0, 1e-16, 1e-12, 1e-9, 1e-7}) {
      const Quat turn = fromAxisAngle(c.point.n, angle - off);
      RigidBody along = a;
      along.x = c.point.pa + turn * (a.x - c.point.pa);
      along.q = turn * a.q;
      updateDerived(along);
      setVelocity(along, a.v, a.omega);
      Contact now = c;
      follow(along, b, now);
      turned = std::max(turned, (now.point.n - c.point.n).norm());
      gap = std::max(gap, std::abs(now.point.separation - c.point.separation));
      CHECK(normalRate(along, b, now.point).allFinite());
      CHECK(placeVelocity(along, b, now.point).allFinite());
      CHECK(std::isfinite(normalAccelerationBias(along, b, now.point)));
    }
  }
  CAPTURE(turned, gap);
  CHECK(turned < 1e-14);
  CHECK(gap < 1e-14);
}

// Oracle: closed form; only rounding remains. Measured 4e-16, allowed 1e-12.
TEST_CASE("an off-centre hit leaves at -e times its approach speed and never gains energy") {
  for (double e : {0.0, 0.5, 1.0}) {
    CAPTURE(e);
    RigidBody box = movingBox({0.0, 0.2, 0.0}, {0, 1, 0}, 0.0, {0.3, -2.0, 0.1}, {0.5, -1.0, 2.0});
    RigidBody ground = makeFixedBody({});
    ContactPoint c;
    c.p = {0.5, 0.0, 0.3};
    c.n = Vec3::UnitY();
    const double approach = approachVelocity(box, ground, c), energy = kineticEnergy(box);
    const double j = collisionImpulse(box, ground, c, e);
    applyImpulse(box, c.p, j * c.n);
    CHECK(j > 0.0);
    CHECK(approachVelocity(box, ground, c) == Approx(-e * approach).epsilon(1e-12).margin(1e-12));
    CHECK(kineticEnergy(box) <= energy * (1.0 + 1e-12));
    if (e == 1.0) CHECK(kineticEnergy(box) == Approx(energy).epsilon(1e-12));
  }
}

// Oracle: momentum. Measured 1e-16, allowed 1e-14.
TEST_CASE("two moving bodies recoil with opposite momenta, and a swap of names changes nothing") {
  RigidBody b = movingBox({0, 0, 0}, {1, 0, 0}, 0.2, {0.1, 1.0, 0.0}, {0.3, 0.1, -0.4});
  RigidBody a = movingBox({0.2, 0.7, 0.1}, {0, 0, 1}, 0.3, {0.0, -1.5, 0.2}, {1.0, 0.0, 0.5});
  ContactPoint c;
  c.p = {0.1, 0.35, 0.0};
  c.n = Vec3(0.1, 1.0, 0.2).normalized();
  ContactPoint swapped = c;
  swapped.n = -c.n;
  const double j = collisionImpulse(a, b, c, 0.7);
  CHECK(collisionImpulse(b, a, swapped, 0.7) == Approx(j).epsilon(1e-14));
  const Vec3 before = a.P + b.P;
  applyImpulse(a, c.p, j * c.n);
  applyImpulse(b, c.p, -j * c.n);
  CHECK((a.P + b.P - before).norm() < 1e-14);
}

TEST_CASE("restitution outside [0, 1] is refused") {
  const RigidBody a = movingBox({0, 1, 0}, {0, 1, 0}, 0, {0, -1, 0}, {0, 0, 0});
  const RigidBody b = makeFixedBody({});
  ContactPoint c;
  for (double e : {-0.1, 1.1, std::nan("")})
    CHECK_THROWS_AS(collisionImpulse(a, b, c, e), std::invalid_argument);
}

// As of points of a cloth that falls on the plane in which it is its own mirror image.
TEST_CASE("tangents are of length 1 along any slip, however slow") {
  const Vec3 n = Vec3(0.1, -1.0, 0.2).normalized();
  for (double speed = 1.0; speed > 0.0; speed *= 1e-3) {
    Vec3 t1, t2;
    tangents(n, speed * Vec3(0.3, 0.5, -0.7), t1, t2);
    CAPTURE(speed);
    CHECK(std::abs(t1.norm() - 1.0) <= 1e-15);
    CHECK(std::abs(t2.norm() - 1.0) <= 1e-15);
    CHECK(std::abs(t1.dot(t2)) <= 1e-15);
  }
}

// Oracle: the certified separation of collide. Ellipsoids of semi-axes of up to 9 : 1 that touch
// somewhere are turned by up to 1.2 rad each, and brought near each other again. Measured 3e-15 m;
// of 400 such pairs 50 were off by up to 0.4 m where Newton's method alone sought the normal.
TEST_CASE("ellipsoids that turn far are followed to where they touch then") {
  scenes::Draws draws{std::mt19937(1)};
  const auto any = [&] { return draws(-1.0, 1.0); };
  const auto direction = [&] { return Vec3(any(), any(), any()).normalized(); };
  const auto oval = [&] {
    const auto axis = [&] { return 0.15 * std::pow(3.0, any()); };
    return Ellipsoid{{axis(), axis(), axis()}};
  };
  const auto turn = [&](RigidBody& body, const Vec3& by) {
    body.q = rotated(body.q, by).normalized();
    updateDerived(body);
  };
  for (int k = 0; k < 40; ++k) {
    CAPTURE(k);
    const Ellipsoid ofA = oval(), ofB = oval();
    RigidBody a = makeBody(solidMass(ofA, 1.0)), b = makeBody(solidMass(ofB, 1.0));
    const Vec3 side = direction();
    const auto bringTo = [&](double gap) {  // along `side`
      double near = 0.0, far = 2.0;
      for (int i = 0; i < 36; ++i) {
        const double middle = 0.5 * (near + far);
        a.x = middle * side;
        (separation(ofA, a.pose(), ofB, b.pose()) > 0.0 ? far : near) = middle;
      }
      a.x = (far + gap) * side;
    };
    for (RigidBody* body : {&a, &b}) turn(*body, 3.0 * direction());
    bringTo(0.0);
    Manifold found;
    collide(ofA, a.pose(), ofB, b.pose(), 1e-6, found);
    REQUIRE(found.size() == 1);
    Contact c;
    c.point = found.front();
    c.anchor = anchorOf(a, b, c.point);
    for (RigidBody* body : {&a, &b}) turn(*body, 1.2 * any() * direction());
    bringTo(2e-3 * any());
    follow(a, b, c);
    CHECK(std::abs(c.point.separation - separation(ofA, a.pose(), ofB, b.pose())) < 1e-13);
  }
}
