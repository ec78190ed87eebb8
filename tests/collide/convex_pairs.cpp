// Chapter 5, collide: capsules, cylinders, hulls and compounds against each other; long, for every
// pair of kinds has its closed form here.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/collide/collide.h"
#include "sim/collide/convex.h"
#include "sim/math/frames.h"
#include "tests/catch.h"
#include "tests/collide/hulls.h"
#include "tests/collide/points.h"

namespace tumble {
namespace {

// Outermost height [m] of a shape along n, written anew for the tests.
double heightAlong(const Shape& shape, const Pose& pose, const Vec3& n) {
  const Vec3 m = pose.q.conjugate() * n;
  double far = 0.0;
  if (const auto* s = std::get_if<Sphere>(&shape)) far = s->r;
  if (const auto* s = std::get_if<Box>(&shape)) far = m.cwiseAbs().dot(s->half);
  if (const auto* s = std::get_if<Capsule>(&shape)) far = s->r + 0.5 * s->h * std::abs(m.y());
  if (const auto* s = std::get_if<Cylinder>(&shape))
    far = s->r * std::sqrt(m.x() * m.x() + m.z() * m.z()) + 0.5 * s->h * std::abs(m.y());
  if (const auto* s = std::get_if<Hull>(&shape)) {
    far = -1e300;
    for (const Vec3& p : s->solid->points) far = std::max(far, m.dot(p - s->origin));
  }
  return n.dot(pose.x) + far;
}

double slab(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB, const Vec3& n) {
  return -heightAlong(a, poseA, -n) - heightAlong(b, poseB, n);
}

Shape someConvex(Random& random, int kind) {
  switch (kind) {
    case 0:
      return Sphere{random.uniform(0.1, 0.7)};
    case 1:
      return random.box(0.1, 0.7);
    case 2: {
      const double r = random.uniform(0.1, 0.7);
      return Cylinder{r, random.uniform(0.1, 1.4)};
    }
    case 3: {
      const double r = random.uniform(0.1, 0.5);
      return Capsule{r, random.uniform(0.1, 1.0)};
    }
    default:
      return someHull(random, 4 + random.below(7));
  }
}

// Shrinking searches over directions, from n: what wider plane can be found.
double widestNear(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB, Vec3 best,
                  Random& random) {
  double widest = slab(a, poseA, b, poseB, best);
  for (double step = 1.0; step > 1e-9; step *= 0.8) {
    for (int k = 0; k < 6; ++k) {
      const Vec3 n = (best + step * random.direction()).normalized();
      const double gap = slab(a, poseA, b, poseB, n);
      if (gap > widest) widest = gap, best = n;
    }
  }
  return widest;
}

// Oracle: support functions written anew. The plane is as wide as it says, its sign is right, and
// searches over directions find none that is wider.
TEST_CASE("the plane between any two convex solids is as wide as it says, and none is wider",
          "[figures]") {
  Random random(61);
  double off = 0.0, missed = 0.0, missedTouching = 0.0, missedRound = 0.0;
  for (int k = 0; k < 4000; ++k) {
    const int kindA = random.below(5);
    const int kindB = random.below(5);
    const Shape a = someConvex(random, kindA);
    const Shape b = someConvex(random, kindB);
    Pose poseA = random.pose(1.0);
    const Pose poseB = random.pose(0.3);
    if (k % 2 == 0) {  // touching, or nearly
      const double target = 1e-3 * random.uniform(-1.0, 1.0);
      for (int m = 0; m < 10; ++m) {
        const ContactPoint c = separatingPlane(a, poseA, b, poseB);
        poseA.x -= (c.separation - target) * c.n;
      }
    }
    const ContactPoint plane = separatingPlane(a, poseA, b, poseB);
    REQUIRE(std::abs(plane.n.norm() - 1.0) < 1e-14);
    if (kindA > 1 || kindB > 1)
      off = std::max(off, std::abs(slab(a, poseA, b, poseB, plane.n) - plane.separation));
    if (kindA == 1 && kindB == 1) continue;  // of two boxes 15 planes are tried
    const double widest = widestNear(a, poseA, b, poseB, plane.n, random);
    const double lost = widest - plane.separation;
    const bool round = kindA == 2 || kindB == 2;
    if (round) {
      missedRound = std::max(missedRound, plane.separation > -1e-3 ? lost : 0.0);
      REQUIRE((widest > 1e-14) == (plane.separation > 1e-14));
      continue;
    }
    if (k % 2 == 0) {
      missedTouching = std::max(missedTouching, lost);
    } else if (plane.separation > 0.0) {
      missed = std::max(missed, lost);
    }
  }
  WARN("planes between convex solids: measured width off by "
       << off << " m, wider by search: apart " << missed << " m, touching to 1 mm "
       << missedTouching << " m; with a cylinder, overlaps to 1 mm, " << missedRound << " m");
  REQUIRE(off < 1e-13);
  REQUIRE(missed < 1e-12);
  REQUIRE(missedTouching < 1e-12);
  REQUIRE(missedRound < 1e-4);
}

// Oracle: the plane. Over a face that is larger than itself a solid touches with its outermost
// corner, however steep the faces are that meet there. Measured 0 m to the digits told, and 14 mm
// where the most level face is taken, which need not reach it; allowed 1e-12.
TEST_CASE("a hull over a large face has a point as deep as the plane between them") {
  Random random(64);
  const Shape slabs[] = {Box{{5.0, 1.0, 5.0}}, Cylinder{5.0, 2.0}, boxHull({5.0, 1.0, 5.0})};
  double off = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const Hull hull = someHull(random, 4 + random.below(9));
    const Shape& slabShape = slabs[k % 3];
    Pose pose = random.pose(1.0);
    const Pose base{Vec3(0.1, -1.0, 0.2), Quat::Identity()};
    pose.x.y() +=
        1e-3 * random.uniform(-10.0, 10.0) - slab(hull, pose, slabShape, base, Vec3::UnitY());
    const bool swapped = k % 2 == 0;
    const ContactPoint plane = swapped ? separatingPlane(slabShape, base, hull, pose)
                                       : separatingPlane(hull, pose, slabShape, base);
    if (std::abs(plane.n.y()) != 1.0) continue;
    const Manifold manifold = swapped ? points(slabShape, base, hull, pose, 0.02)
                                      : points(hull, pose, slabShape, base, 0.02);
    double least = 1.0;
    for (const ContactPoint& c : manifold) least = std::min(least, c.separation);
    off = std::max(off, std::abs(least - plane.separation));
  }
  CHECK(off < 1e-12);
}

// Oracle: the plane. Where edges cross, the facets that the two show have these edges, however
// square another is that has a corner of one alone. Measured 1e-10 m, where edges are nearly
// parallel, and 12 mm where such a square one is taken; allowed 1e-8.
TEST_CASE("hulls whose edges cross touch as deep as the plane between them") {
  Random random(65);
  double off = 0.0;
  int crossed = 0;
  for (int k = 0; k < 6000; ++k) {
    const Shape a = someHull(random, 4 + random.below(12));
    const Shape b =
        k % 2 == 0 ? Shape(random.box(0.1, 0.7)) : someHull(random, 4 + random.below(12));
    Pose poseA = random.pose(0.5);
    const Pose poseB = random.pose(0.5);
    for (int m = 0; m < 10; ++m) {
      const ContactPoint c = separatingPlane(a, poseA, b, poseB);
      poseA.x -= (c.separation + 1e-4) * c.n;
    }
    const ContactPoint plane = separatingPlane(a, poseA, b, poseB);
    if (plane.tie != NormalTie::Edges) continue;
    ++crossed;
    double least = 1.0;
    for (const ContactPoint& c : points(a, poseA, b, poseB, 0.02))
      least = std::min(least, c.separation);
    off = std::max(off, std::abs(least - plane.separation));
  }
  CHECK(crossed > 2000);
  CHECK(off < 1e-8);
}

// Oracle: a prism inside and one around the cylinder, in the path of polyhedra. They differ by
// r (1/cos(π/64) − 1) = 1.2e-3 r. Overlaps deeper than 2 cm may be too deep by a
// hundredth: the widest plane is then one of several that are each the widest near it.
TEST_CASE("the gap of a cylinder is between those of the prisms inside and around it") {
  Random random(62);
  const double wider = 1.0 / std::cos(3.141592653589793 / 64);
  const double r = 0.5, h = 0.8;
  const Hull inside = prismHull(64, r, h), around = prismHull(64, wider * r, h);
  int overlapping = 0;
  for (int k = 0; k < 300; ++k) {
    const Shape b = someConvex(random, 1 + random.below(4));
    const Pose poseA = random.pose(0.9), poseB = random.pose(0.2);
    const double gap = separation(Cylinder{r, h}, poseA, b, poseB);
    const double most = separation(inside, poseA, b, poseB);
    const double least = separation(around, poseA, b, poseB);
    if (gap < 0.0) ++overlapping;
    CAPTURE(b.index(), gap, most, least);
    REQUIRE(gap <= most + 1e-12);
    REQUIRE(gap >= (gap < -0.02 ? 1.01 * least : least - 1e-10));
  }
  REQUIRE(overlapping > 50);
}

// Oracle: closed form. The point of a cylinder nearest to a point.
TEST_CASE("a ball is as far from a cylinder as its centre, less its radius") {
  Random random(63);
  const Cylinder cylinder{0.5, 0.8};
  double worst = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const Pose pose = random.pose(1.0), ball{random.vector(-1.0, 1.0), Quat::Identity()};
    const Vec3 p = toBody(pose, ball.x);
    const double out = std::sqrt(p.x() * p.x() + p.z() * p.z()) - cylinder.r;
    const double up = std::abs(p.y()) - 0.5 * cylinder.h;
    const double gap = out > 0.0 && up > 0.0 ? std::sqrt(out * out + up * up) : std::max(out, up);
    const double found = separation(Sphere{0.2}, ball, cylinder, pose);
    worst = std::max(worst, std::abs(found - (gap - 0.2)));
  }
  CAPTURE(worst);
  REQUIRE(worst < 1e-14);
}

TEST_CASE("a cylinder stands on eight points, lies on two, leans on one") {
  const Cylinder c{0.5, 0.8};
  const HalfSpace floor;
  const Box slabBox{{5.0, 0.5, 5.0}};
  const double lean = 30.0, s = 0.5, cosine = std::sqrt(0.75);
  const struct {
    double height;
    Quat q;
    std::size_t count;
  } cases[] = {{0.4, Quat::Identity(), 8},
               {0.5, turn(Vec3::UnitX(), 90.0), 2},
               {0.4 * cosine + 0.5 * s, turn(Vec3::UnitZ(), lean), 1}};
  for (const auto& [height, q, count] : cases) {
    for (const double off : {-1e-12, 0.0, 1e-12}) {
      const Pose pose{{0.1, height + off, 0.2}, q};
      for (const bool flat : {true, false}) {
        const Shape ground = flat ? Shape(floor) : Shape(slabBox);
        const Pose below{{0.0, flat ? 0.0 : -0.5, 0.0}, Quat::Identity()};
        const Manifold manifold = points(c, pose, ground, below, 1e-9);
        CAPTURE(count, flat, off);
        REQUIRE(manifold.size() == count);
        REQUIRE(std::abs(separation(c, pose, ground, below) - off) < 1e-15);
        for (const ContactPoint& p : manifold) {
          REQUIRE((p.n - Vec3::UnitY()).norm() < 1e-14);
          REQUIRE(std::abs(p.p.y()) < 1e-11);
          REQUIRE(p.tie == NormalTie::FaceOfB);
        }
      }
    }
  }
}

// Oracle: alternating projection between the two segments.
TEST_CASE("capsules are as far apart as their segments, less their radii") {
  Random random(64);
  double worst = 0.0;
  int crossing = 0;
  for (int k = 0; k < 3000; ++k) {
    const Capsule a{0.2, 1.0}, b{0.1, 0.6};
    Pose poseA = random.pose(1.0);
    const Pose poseB = random.pose(0.5);
    if (k % 5 == 0) poseA.q = poseB.q;
    Vec3 p = poseA.x, q = poseB.x;
    for (int m = 0; m < 20000; ++m) {
      const double y = std::clamp(toBody(poseB, p).y(), -0.5 * b.h, 0.5 * b.h);
      q = toWorld(poseB, {0.0, y, 0.0});
      const double x = std::clamp(toBody(poseA, q).y(), -0.5 * a.h, 0.5 * a.h);
      const Vec3 next = toWorld(poseA, {0.0, x, 0.0});
      const bool still = (next - p).norm() < 1e-16;
      p = next;
      if (still) break;
    }
    const ContactPoint c = separatingPlane(a, poseA, b, poseB);
    if (c.tie == NormalTie::Edges) ++crossing;
    worst = std::max(worst, std::abs(c.separation - ((p - q).norm() - 0.3)));
  }
  CAPTURE(worst, crossing);
  REQUIRE(crossing > 300);
  REQUIRE(worst < 1e-12);
}

TEST_CASE("a capsule lies on two points, of a box or of another capsule, and stands on one") {
  const Capsule c{0.25, 1.0};
  const Quat lying = turn(Vec3::UnitZ(), 90.0);
  const Box table{{2.0, 0.5, 2.0}};
  const Pose below{{0.0, -0.5, 0.0}, Quat::Identity()};
  const Manifold flat = points(c, {{0.0, 0.25, 0.0}, lying}, table, below, 1e-9);
  REQUIRE(flat.size() == 2);
  for (const ContactPoint& p : flat) {
    REQUIRE(p.tie == NormalTie::FaceOfB);
    REQUIRE(p.ra == 0.25);
    REQUIRE((p.p - Vec3(p.p.x() < 0.0 ? -0.5 : 0.5, 0.0, 0.0)).norm() < 1e-14);
  }
  REQUIRE(points(c, {{0.0, 0.75, 0.0}, Quat::Identity()}, table, below, 1e-9).size() == 1);
  const Manifold pile = points(c, {{0.2, 0.5, 0.0}, lying}, c, {Vec3::Zero(), lying}, 1e-9);
  REQUIRE(pile.size() == 2);
  for (const ContactPoint& p : pile) {
    REQUIRE((p.n - Vec3::UnitY()).norm() < 1e-14);
    REQUIRE((p.p - Vec3(p.p.x() < 0.0 ? -0.3 : 0.5, 0.25, 0.0)).norm() < 1e-14);
  }
}

// Oracle: geometry by hand. Two points alone, where axes cross, would let one turn into the other.
// Measured: off by at most 1.1e-16 m.
TEST_CASE("capsules that cross at any angle touch where they do, and near both ends") {
  const Capsule c{0.25, 1.0};
  const double rise = 0.51;  // [m] from axis to axis
  double worst = 0.0;
  for (const double angle : {-0.3, -0.02, 2e-3, 0.02, 0.3}) {
    const Quat lying = turn(Vec3::UnitZ(), 90.0), across = rotated(lying, Vec3(0.0, angle, 0.0));
    const Pose above{{0.1, rise, 0.0}, across}, below{Vec3::Zero(), lying};
    const Manifold near = points(c, above, c, below, 0.1);
    CAPTURE(angle, near.size());
    REQUIRE(near.size() == 3);
    REQUIRE(points(c, above, c, below, 0.011).size() == (std::abs(angle) < 0.1 ? 3 : 1));
    // The upper one goes from 0.1 on to both sides, the lower one ends at 0.5: of what they share
    // that is one end, and the upper one's own end the other.
    for (const ContactPoint& p : near) {
      const double x = p.pb.x(), aside = (x > 0.4 ? 0.4 : 0.5) * std::sin(angle);
      const double gap = p.tie == NormalTie::Edges ? rise : std::hypot(rise, aside);
      worst = std::max(worst, std::abs(p.separation - (gap - 0.5)));
      worst = std::max(worst, (p.pa - p.pb - (p.separation + 0.5) * p.n).norm());
    }
  }
  CAPTURE(worst);
  CHECK(worst < 1e-15);
}

// Oracle: two methods agree. Measured below 1e-15 m.
TEST_CASE("a box made as a hull meets boxes with the same gap and points as the box") {
  Random random(65);
  int touching = 0;
  double worst = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const Box a = random.box(), b = random.box();
    const Pose poseA = random.pose(0.7), poseB = random.pose(0.7);
    const double gap = separation(a, poseA, b, poseB);
    const double hullGap = separation(boxHull(a.half), poseA, boxHull(b.half), poseB);
    if (gap > 0.0) {
      REQUIRE(hullGap >= gap - 1e-14);
      continue;
    }
    worst = std::max(worst, std::abs(gap - hullGap));
    const Manifold one = points(a, poseA, b, poseB, 0.01);
    const Manifold other = points(boxHull(a.half), poseA, boxHull(b.half), poseB, 0.01);
    REQUIRE(one.size() == other.size());
    for (const ContactPoint& c : one)
      REQUIRE(std::any_of(other.begin(), other.end(),
                          [&](const ContactPoint& o) { return (o.p - c.p).norm() < 1e-11; }));
    ++touching;
  }
  REQUIRE(touching > 500);
  REQUIRE(worst < 1e-13);
}

// Oracle: geometry by hand. Measured: off by at most 5.3e-17 m over the angle.
TEST_CASE("edges that are almost parallel cross where their lines do") {
  const Hull bar = boxHull({1.0, 0.1, 0.1});
  const Quat onEdge = turn(Vec3::UnitX(), 45.0);
  const double gap = 0.01, top = 0.1 * std::sqrt(2.0);
  for (double angle = 0.1; angle > 1e-13; angle *= 0.1) {
    const Pose above{{0.03, 2.0 * top + gap, 0.0},
                     Quat(Eigen::AngleAxisd(angle, Vec3::UnitY())) * onEdge};
    const ContactPoint c = separatingPlane(bar, above, bar, {Vec3::Zero(), onEdge});
    INFO("angle " << angle << " tie " << static_cast<int>(c.tie) << " at " << c.pa.transpose());
    REQUIRE(std::abs(c.separation - gap) < 1e-15);
    REQUIRE(c.tie == NormalTie::Edges);
    REQUIRE((c.pa - Vec3(0.03, top + gap, 0.0)).norm() < 1e-15 / angle);
  }
}

// Oracle: geometry by hand.
TEST_CASE("an L of two boxes touches with both, and their points have names of their own") {
  Compound ell;
  ell.parts.push_back({Box{{1.0, 0.25, 0.5}}, {{0.0, 0.25, 0.0}, Quat::Identity()}});
  ell.parts.push_back({Box{{0.25, 0.75, 0.5}}, {{-0.75, 1.25, 0.0}, Quat::Identity()}});
  ell.origin = {0.1, 0.2, 0.3};
  // A ball in the corner of the L touches the foot and the stem.
  const Vec3 corner(-0.5, 0.5, 0.0);
  const Pose ball{corner - ell.origin + Vec3(0.2, 0.2, 0.0), Quat::Identity()};
  const Manifold manifold = points(Sphere{0.2}, ball, ell, Pose{}, 1e-9);
  REQUIRE(manifold.size() == 2);
  REQUIRE((manifold[0].n - Vec3::UnitY()).norm() < 1e-14);
  REQUIRE((manifold[1].n - Vec3::UnitX()).norm() < 1e-14);
  REQUIRE(manifold[0].feature != manifold[1].feature);
  REQUIRE(std::abs(separation(Sphere{0.2}, ball, ell, Pose{})) < 1e-15);
  // In the air beside the stem, above the foot, its hull would be hit.
  const Pose above{corner - ell.origin + Vec3(0.5, 0.5, 0.0), Quat::Identity()};
  REQUIRE(std::abs(separation(Sphere{0.2}, above, ell, Pose{}) - 0.3) < 1e-15);
  REQUIRE(separatingPlane(ell, Pose{}, Sphere{0.2}, above).n.y() < 0.0);
}

}  // namespace
// Oracle: how deep the bar's lower end is put. The top of the block is bent by rounding, so that it
// is two triangles; the bar leans over both, one end in the block. What the facets share may lie
// over the triangle that it does not touch: the end that is deep had no point, and sank in unheld.
TEST_CASE("what overlaps beside the facet that is nearest has a point, in any margin") {
  constexpr double kBent = 1e-10, kDeep = 2e-3, kLean = 0.02;  // [m], [m], [rad]
  std::vector<Vec3> corners;
  for (const double x : {-1.0, 1.0})
    for (const double z : {-1.0, 1.0})
      corners.push_back({x, -1.0, z}), corners.push_back({x, x * z > 0.0 ? 0.0 : -kBent, z});
  const Shape block = hullOf(corners), bar = Box{{0.6, 0.05, 0.05}};
  for (int eighth = 0; eighth < 8; ++eighth) {
    const Quat q =
        turn(Vec3::UnitY(), 45.0 * eighth + 10.0) * Quat(Eigen::AngleAxisd(kLean, Vec3::UnitZ()));
    const Mat3 R = q.toRotationMatrix();
    const double below = R.row(1).cwiseAbs().dot(Vec3(0.6, 0.05, 0.05));
    const Pose pose{{0.0, below - kDeep, 0.0}, q};
    for (const double margin : {1e-3, 0.01, 0.3}) {
      Manifold found;
      collide(bar, pose, block, {}, margin, found);
      double least = 0.0;
      for (const ContactPoint& c : found) least = std::min(least, c.separation);
      CAPTURE(eighth, margin);
      CHECK(least == Approx(-kDeep).margin(1e-5));
    }
  }
}

// Oracle: a plane's gap is the least way along its normal between points of the two. The sides of a
// sliver hardly part, so that the tolerance takes in what is far beyond its end. Measured 2.5e-8 m
// less, allowed 4e-6 m, ten of the tolerance.
TEST_CASE("no contact point is nearer along a plane than the plane is wide, on a sliver either") {
  constexpr double kTolerance = 4e-7, kLength = 0.02, kThick = 2e-5;  // m
  Random random(3);
  double least = 0.0;
  std::vector<convex::Plane> planes;
  Manifold found;
  for (int k = 0; k < 300; ++k) {
    std::vector<Vec3> points = {Vec3(0.0, kLength, 0.0)};
    for (int corner = 0; corner < 3; ++corner)
      points.push_back(kThick * Vec3(1.0, 1.0, 0.03).cwiseProduct(random.direction()));
    const Hull needle = hullOf(points), block = boxHull({0.05, 0.01, 0.04});
    const Quat q = fromAxisAngle(Vec3::UnitX(), std::numbers::pi) *
                   rotated(Quat::Identity(), random.uniform(0.0, 1.0) * random.direction());
    const convex::Core a = convex::coreOf(block, Mat3::Identity(), Vec3::Zero());
    const convex::Core b =
        convex::coreOf(needle, q.toRotationMatrix(),
                       Vec3(random.uniform(-0.03, 0.03), random.uniform(0.011, 0.035),
                            random.uniform(-0.03, 0.03)));
    convex::allAxes(a, b, planes);
    for (const convex::Plane& plane : planes) {
      if (plane.gap < -0.01) continue;
      found.clear();
      convex::clipFacets(a, b, plane, kTolerance, 0.1, found);
      for (const ContactPoint& c : found) least = std::min(least, c.separation - plane.gap);
    }
  }
  CAPTURE(least);
  CHECK(least > -10.0 * kTolerance);
}

}  // namespace tumble
