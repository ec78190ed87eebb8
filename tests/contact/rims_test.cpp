// Contacts of cylinders: rims and sides that roll and wander, held to the shapes themselves.
#include <algorithm>
#include <cmath>

#include "sim/body/mass_properties.h"
#include "sim/collide/collide.h"
#include "sim/contact/contact.h"
#include "sim/math/frames.h"
#include "sim/math/rotation.h"
#include "tests/catch.h"
#include "tests/collide/hulls.h"
#include "tests/contact/coasted.h"

using namespace tumble;

namespace {

RigidBody moving(const Shape& shape, const Pose& pose, const Vec3& v, const Vec3& omega) {
  RigidBody body = std::holds_alternative<HalfSpace>(shape) ? makeFixedBody({})
                                                            : makeBody(solidMass(shape, 1000.0));
  body.x = pose.x;
  body.q = pose.q;
  updateDerived(body);
  if (!body.fixed()) setVelocity(body, v, omega);
  return body;
}

Shape other(Random& random, int kind) {
  switch (kind) {
    case 0:
      return HalfSpace{};
    case 1:
      return random.box(0.2, 0.7);
    case 2:
      return Cylinder{0.4, 0.5};
    case 3:
      return Capsule{0.2, 0.6};
    case 4:
      return Sphere{0.3};
    default:
      return someHull(random, 8);
  }
}

struct WorstRates {
  double rate = 0.0, speed = 0.0, bend = 0.0, place = 0.0;
};

/// Contacts of a shape with `kinds` others, held to central differences of their gaps.
void requireFollows(const Shape& shapeA, int kinds) {
  Random random(91);
  WorstRates worst;
  int seen[7] = {}, rims = 0;
  for (int k = 0; k < 100 * kinds; ++k) {
    const int kind = k % kinds;
    const Shape shapeB = kind == 6 ? Shape(Ellipsoid{{0.2, 0.5, 0.3}}) : other(random, kind);
    const Pose poseB = kind == 0 ? Pose{} : random.pose(0.3);
    Pose poseA = random.pose(0.8);
    for (int m = 0; m < 20; ++m) {
      const ContactPoint c = separatingPlane(shapeA, poseA, shapeB, poseB);
      poseA.x -= (c.separation - 0.02) * c.n;
    }
    const Vec3 va = random.vector(-0.3, 0.3), wa = random.vector(-0.5, 0.5);
    const Vec3 vb = random.vector(-0.3, 0.3), wb = random.vector(-0.5, 0.5);
    const RigidBody a = moving(shapeA, poseA, va, wa), b = moving(shapeB, poseB, vb, wb);
    Contact c;
    c.point = separatingPlane(shapeA, poseA, shapeB, poseB);
    c.anchor = anchorOf(a, b, c.point);
    constexpr double h = 1e-4;
    ContactPoint at[5];
    Contact followed[5];
    bool same = true;
    for (int s = -2; s <= 2; ++s) {
      const RigidBody a1 = coasted(a, s * h), b1 = coasted(b, s * h);
      at[s + 2] = separatingPlane(shapeA, a1.pose(), shapeB, b1.pose());
      followed[s + 2] = c;
      follow(a1, b1, followed[s + 2]);
      const ContactPoint& p = followed[s + 2].point;
      same = same && at[s + 2].tie == c.point.tie && at[s + 2].feature == c.point.feature &&
             std::abs(p.separation - at[s + 2].separation) < 1e-9;
    }
    if (!same) continue;
    ++seen[kind];
    rims += c.point.rimA + c.point.rimB > 0.0 ? 1 : 0;
    const auto slope = [&](auto value) -> decltype(value(0)) {
      return ((value(0) - value(4)) + 8.0 * (value(3) - value(1))) / (12.0 * h);
    };
    const auto gap = [&](int i) { return at[i].separation; };
    const Vec3 rate = slope([&](int i) { return Vec3(at[i].n); });
    const Vec3 place = slope([&](int i) { return Vec3(followed[i].point.p); });
    const double bend =
        (-gap(0) + 16.0 * gap(1) - 30.0 * gap(2) + 16.0 * gap(3) - gap(4)) / (12.0 * h * h);
    worst.rate = std::max(worst.rate, (rate - normalRate(a, b, c.point)).norm());
    worst.speed =
        std::max(worst.speed, std::abs(slope(gap) - c.point.n.dot(pointVelocity(a, c.point.pa) -
                                                                  pointVelocity(b, c.point.pb))));
    worst.bend = std::max(worst.bend, std::abs(bend - normalAccelerationBias(a, b, c.point)));
    // The place is midway between the surfaces, which counts where they do not touch.
    Vec3 off = place - placeVelocity(a, b, c.point);
    off -= off.dot(c.point.n) * c.point.n;
    worst.place = std::max(worst.place, off.norm() - 0.5 * c.point.separation * rate.norm());
  }
  CAPTURE(worst.rate, worst.speed, worst.bend, worst.place, rims);
  for (int kind = 0; kind < kinds; ++kind) CHECK(seen[kind] > 60);
  CHECK(rims > 200);
  CHECK(worst.rate < 3e-7);
  CHECK(worst.speed < 1e-9);
  CHECK(worst.bend < 1e-6);
  CHECK(worst.place < 1e-8);
}

}  // namespace

// Oracle: central differences, of order four, of the gap between the shapes and of their widest
// plane; h = 1e-4 s. Where the features change within 2 h the differences are of something else:
// these are told by the tie, and left out. Measured 3e-8, 4e-11, 1e-7 and 1e-9; allowed ten times
// that.
TEST_CASE("a cylinder's contact follows the gap of the shapes to second order") {
  requireFollows(Cylinder{0.3, 0.5}, 6);
}

// The same. Measured 2e-11, 4e-12, 1e-7 and 2e-12: but for differences, nothing.
TEST_CASE("an ellipsoid's contact follows the gap of the shapes to second order") {
  requireFollows(Ellipsoid{{0.4, 0.2, 0.3}}, 7);
}

// Oracle: closed form. A line through a point P of a rim touches it there, along n square to the
// line and to the rim, however little it leans against the disc; where it lies flat n is the axis,
// and the outermost point of the rim along n is any.
TEST_CASE("a side that comes to lie on a disc is followed along its rim to the last") {
  constexpr double kRound = 0.55;  // [rad] from outward to the line, on the disc
  const Cylinder disc{1.5, 0.2}, bar{0.11, 0.08};
  const Vec3 P(disc.r, 0.5 * disc.h, 0.0), along(0.0, 0.0, 1.0);
  const RigidBody b = moving(disc, Pose{}, Vec3::Zero(), Vec3::Zero());
  const auto leaning = [&](double lean, Vec3& n) {
    const Vec3 e(std::cos(kRound) * std::cos(lean), -std::sin(lean),
                 std::sin(kRound) * std::cos(lean));
    n = along.cross(e).normalized();
    const Pose pose{P + bar.r * n + 0.01 * e, Quat::FromTwoVectors(Vec3::UnitY(), e)};
    return moving(bar, pose, Vec3::Zero(), Vec3::Zero());
  };
  Vec3 n;
  const RigidBody start = leaning(3e-3, n);
  Contact found;
  found.point = separatingPlane(bar, start.pose(), disc, b.pose());
  REQUIRE(found.point.rimB == disc.r);
  REQUIRE((found.point.n - n).norm() < 1e-12);
  found.anchor = anchorOf(start, b, found.point);
  double place = 0.0, turn = 0.0, gap = 0.0;
  for (const double lean : {1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5}) {
    const RigidBody a = leaning(lean, n);
    Contact c = found;
    follow(a, b, c);
    place = std::max(place, (c.point.p - P).norm() * lean);
    turn = std::max(turn, (c.point.n - n).norm());
    gap = std::max(gap, std::abs(c.point.separation));
  }
  CAPTURE(place, turn, gap);
  CHECK(place < 1e-14);
  CHECK(turn < 1e-14);
  CHECK(gap < 1e-14);
}

// Oracle: what it is by definition – points of the circle and of a line, or another circle, whose
// offset is square to both – and central differences of that, of order four, h = 1e-3 s. Both
// bodies turn, and the disc passes through where it lies flat on the edge, sharp, round or a rim:
// there the outermost point of its rim along n is any, and comes to be on the far side. Measured
// 7e-17, and 1e-10, 2e-12, 3e-10 and 5e-11.
TEST_CASE("a disc that comes to lie on an edge, and beyond, is followed where its rim crosses it") {
  constexpr double kRadius = 0.3, h = 1e-3;
  const Vec3 rim(0.0, -0.05, 0.0);  // its centre in the disc
  const Vec3 out(std::cos(0.6), 0.0, std::sin(0.6)), edge = Vec3::UnitX();
  double on = 0.0, rate = 0.0, speed = 0.0, bend = 0.0, place = 0.0;
  for (const auto& [round, other] :
       {std::pair(0.0, 0.0), std::pair(0.2, 0.0), std::pair(0.0, 0.2)}) {
    const RigidBody a = moving(Cylinder{kRadius, 0.1}, {-kRadius * out - rim, Quat::Identity()},
                               {0.1, -0.2, 0.3}, Vec3::UnitY().cross(out) + Vec3(0.2, 0.5, -0.1));
    const RigidBody b = moving(Box{{0.5, 0.5, 0.5}}, {{0.1, -0.6, 0.2}, Quat::Identity()},
                               {0.0, 0.1, 0.2}, {-0.2, 0.4, 0.3});
    Contact start;
    start.point.tie = NormalTie::Edges;
    start.point.crosses = true;
    start.point.rimA = kRadius;
    start.point.ea = out;
    start.point.rimB = other;
    start.point.eb = other > 0.0 ? Vec3(Vec3::UnitZ()) : edge;
    start.point.pb = -round * Vec3::UnitY();
    start.point.rb = round;
    start.anchor = anchorOf(a, b, start.point);
    const auto at = [&](double t) {
      Contact c = start;
      follow(coasted(a, t), coasted(b, t), c);
      return c.point;
    };
    for (int k = -20; k <= 20; ++k) {
      const double t = 1e-3 * k;
      const RigidBody a1 = coasted(a, t), b1 = coasted(b, t);
      const ContactPoint c = at(t);
      const Vec3 axis = a1.q * Vec3::UnitY(), spoke = c.pa - toWorld(a1.pose(), rim);
      const Vec3 middle = start.point.pb - other * Vec3::UnitZ();
      const Vec3 fromMiddle = c.pb - toWorld(b1.pose(), toBody(b.pose(), middle));
      const Vec3 axisB = b1.q * Vec3::UnitY();
      const Vec3 line = other > 0.0 ? axisB.cross(fromMiddle) : Vec3(b1.q * edge);
      const double off = other > 0.0
                             ? std::abs(fromMiddle.norm() - other) + std::abs(axisB.dot(fromMiddle))
                             : fromMiddle.cross(line).norm();
      on = std::max({on, std::abs(axis.dot(spoke)), std::abs(spoke.norm() - kRadius), off,
                     std::abs(c.n.dot(axis.cross(spoke))), std::abs(c.n.dot(line)),
                     (c.pa - c.pb - (c.separation + round) * c.n).norm()});
      const auto slope = [&](auto value) -> decltype(value(0.0)) {
        return ((value(t - 2 * h) - value(t + 2 * h)) + 8.0 * (value(t + h) - value(t - h))) /
               (12.0 * h);
      };
      const auto gap = [&](double s) { return at(s).separation; };
      rate = std::max(
          rate, (slope([&](double s) { return Vec3(at(s).n); }) - normalRate(a1, b1, c)).norm());
      speed = std::max(
          speed, std::abs(slope(gap) - c.n.dot(pointVelocity(a1, c.pa) - pointVelocity(b1, c.pb))));
      bend = std::max(bend, std::abs((-gap(t - 2 * h) + 16.0 * gap(t - h) - 30.0 * gap(t) +
                                      16.0 * gap(t + h) - gap(t + 2 * h)) /
                                         (12.0 * h * h) -
                                     normalAccelerationBias(a1, b1, c)));
      const Vec3 surface = slope([&](double s) { return Vec3(at(s).pa); });
      place = std::max(place, (surface - placeVelocity(a1, b1, c)).norm());
    }
  }
  CAPTURE(on, rate, speed, bend, place);
  CHECK(on < 1e-15);
  CHECK(rate < 1e-9);
  CHECK(speed < 1e-11);
  CHECK(bend < 3e-9);
  CHECK(place < 4e-10);
}
