// Chapter 5, collide: balls against balls, boxes and half-spaces; boxes against half-spaces.
#include <algorithm>
#include <cmath>
#include <set>

#include "sim/collide/collide.h"
#include "sim/collide/features.h"
#include "sim/math/frames.h"
#include "sim/math/rotation.h"
#include "tests/catch.h"
#include "tests/collide/points.h"
#include "tests/collide/random_pose.h"

namespace tumble {
namespace {

const Box kBox{{1.0, 2.0, 3.0}};

ContactPoint onlyPoint(const Shape& a, const Vec3& xa, const Shape& b, double margin = 0.1) {
  const Manifold manifold = points(a, {xa, Quat::Identity()}, b, Pose{}, margin);
  REQUIRE(manifold.size() == 1);
  return manifold[0];
}

TEST_CASE("two balls touch on the line of their centres") {
  const ContactPoint c = onlyPoint(Sphere{0.5}, {0.0, 0.0, 2.25}, Sphere{1.5}, 0.5);
  REQUIRE(c.n == Vec3::UnitZ());
  REQUIRE(c.separation == 0.25);
  REQUIRE(c.p == Vec3(0.0, 0.0, 1.625));
  REQUIRE(c.tie == NormalTie::Points);
  REQUIRE(c.ra == 0.5);
  REQUIRE(c.rb == 1.5);
}

TEST_CASE("concentric balls part along the world's Y, wherever they are") {
  const ContactPoint c = onlyPoint(Sphere{0.5}, Vec3::Zero(), Sphere{1.5});
  REQUIRE(c.n == Vec3::UnitY());
  REQUIRE(c.separation == -2.0);
  REQUIRE(onlyPoint(Sphere{0.5}, {1e-200, 0.0, 0.0}, Sphere{1.5}).n == Vec3::UnitY());
  REQUIRE(onlyPoint(Sphere{0.5}, {1e-100, 0.0, 0.0}, Sphere{1.5}).n == Vec3::UnitX());
}

TEST_CASE("a ball meets a box at a face, an edge or a vertex, and n rides on what it meets") {
  const double r = 0.5, leg = 0.3;
  const ContactPoint face = onlyPoint(Sphere{r}, {1.5, 0.5, -1.0}, kBox);
  REQUIRE(face.tie == NormalTie::FaceOfB);
  REQUIRE(face.n == Vec3::UnitX());
  REQUIRE(face.separation == 0.0);
  REQUIRE(face.p == Vec3(1.0, 0.5, -1.0));

  const ContactPoint edge = onlyPoint(Sphere{r}, {1.0 + leg, -2.4, -1.0}, kBox);
  REQUIRE(edge.tie == NormalTie::EdgeOfB);
  REQUIRE((edge.n - Vec3(0.6, -0.8, 0.0)).norm() < 1e-15);
  REQUIRE(std::abs(edge.separation) < 1e-15);
  REQUIRE(edge.eb == Vec3::UnitZ());
  REQUIRE(edge.pb == Vec3(1.0, -2.0, -1.0));

  const ContactPoint corner = onlyPoint(Sphere{r}, {-1.2, 2.2, 3.1}, kBox);
  REQUIRE(corner.tie == NormalTie::Points);
  REQUIRE((corner.n - Vec3(-2.0, 2.0, 1.0) / 3.0).norm() < 1e-15);
  REQUIRE(std::abs(corner.separation + 0.2) < 1e-15);
  REQUIRE(corner.pa == Vec3(-1.2, 2.2, 3.1));
  REQUIRE(corner.ra == r);
}

TEST_CASE("a ball whose centre is in the box leaves through the nearest face") {
  const ContactPoint c = onlyPoint(Sphere{0.5}, {0.25, -1.5, 0.0}, kBox);
  REQUIRE(c.n == -Vec3::UnitY());
  REQUIRE(c.separation == -1.0);
  REQUIRE(c.tie == NormalTie::FaceOfB);
  REQUIRE(c.pb == Vec3(0.25, -2.0, 0.0));
  REQUIRE(onlyPoint(Sphere{0.5}, Vec3::Zero(), kBox).n == Vec3::UnitX());
}

// The widest slab n·x_B − Σ half |nᵢ| over all unit n: shrinking searches from many starts.
double widestSlab(const Vec3& x_B, const Vec3& half, Random& random) {
  const auto slab = [&](const Vec3& n) { return n.dot(x_B) - n.cwiseAbs().dot(half); };
  double widest = -1e300;
  for (int start = 0; start < 30; ++start) {
    Vec3 best = random.direction();
    for (double step = 1.0; step > 1e-11; step *= 0.97) {
      for (int k = 0; k < 4; ++k) {
        const Vec3 n = (best + step * random.direction()).normalized();
        if (slab(n) > slab(best)) best = n;
      }
    }
    widest = std::max(widest, slab(best));
  }
  return widest;
}

// Oracle: search over directions. It finds nothing wider, and comes as near as
// 4e-6 to the gap; allowed 1e-4.
TEST_CASE("the gap of a ball and a box is the widest slab between them, outside and inside") {
  Random random(31);
  const Pose pose = random.pose(1.0);
  double worst = 0.0;
  int inside = 0;
  for (int k = 0; k < 100; ++k) {
    const Vec3 x = random.vector(-4.0, 4.0);
    const double gap = separation(Sphere{0.5}, {x, Quat::Identity()}, kBox, pose) + 0.5;
    const double widest = widestSlab(toBody(pose, x), kBox.half, random);
    if (gap < 0.0) ++inside;
    REQUIRE(widest <= gap + 1e-14);
    worst = std::max(worst, gap - widest);
  }
  CAPTURE(worst, inside);
  REQUIRE(inside > 5);
  REQUIRE(worst < 1e-4);
}

TEST_CASE("the gap of a ball and a box does not jump where the nearest feature changes") {
  const double step = 1e-9;
  for (const Vec3& x : {Vec3(1.0, 0.0, 0.0), Vec3(1.0, 2.0, 0.0), Vec3(1.0, 2.0, 3.0),
                        Vec3(1.5, 2.0, 0.0), Vec3(0.5, 1.5, 0.0), Vec3(1.5, 2.5, 3.0)}) {
    Random random(32);
    const double here = separation(Sphere{0.5}, {x, Quat::Identity()}, kBox, Pose{});
    for (int k = 0; k < 100; ++k) {
      const Vec3 near = x + step * random.direction();
      const double there = separation(Sphere{0.5}, {near, Quat::Identity()}, kBox, Pose{});
      REQUIRE(std::abs(there - here) <= step * (1.0 + 1e-6));
    }
  }
}

// The 26 regions around a box, told by the signs of the ball's place along each axis.
TEST_CASE("each vertex, edge and face of a box has a name of its own, the same all over it") {
  std::set<std::uint64_t> names;
  for (int region = 0; region < 27; ++region) {
    const Vec3 side(region % 3 - 1, region / 3 % 3 - 1, region / 9 - 1);
    if (side.isZero()) continue;
    const Vec3 x = side.cwiseProduct(kBox.half + Vec3::Constant(0.1));
    const ContactPoint here = onlyPoint(Sphere{0.5}, x, kBox);
    names.insert(here.feature);
    for (int k = 0; k < 3; ++k) {
      const Vec3 aside = x + 0.05 * Vec3::Unit(k);
      REQUIRE(onlyPoint(Sphere{0.5}, aside, kBox).feature == here.feature);
    }
  }
  REQUIRE(names.size() == 26);
}

TEST_CASE("a box against a ball is the mirror image of the ball against the box") {
  for (const Vec3& x : {Vec3(1.5, 0.5, -1.0), Vec3(1.3, -2.4, -1.0), Vec3(-1.2, 2.2, 3.1)}) {
    const Pose ball{x, Quat::Identity()};
    const ContactPoint one = points(Sphere{0.5}, ball, kBox, Pose{}, 0.1).at(0);
    const ContactPoint other = points(kBox, Pose{}, Sphere{0.5}, ball, 0.1).at(0);
    REQUIRE(other.n == -one.n);
    REQUIRE(other.p == one.p);
    REQUIRE(other.pa == one.pb);
    REQUIRE(other.pb == one.pa);
    REQUIRE(other.rb == one.ra);
    REQUIRE(other.ra == 0.0);
    REQUIRE(other.ea == one.eb);
    REQUIRE(other.separation == one.separation);
    REQUIRE(other.feature == swappedFeature(one.feature));
    if (one.tie == NormalTie::FaceOfB) REQUIRE(other.tie == NormalTie::FaceOfA);
    if (one.tie == NormalTie::EdgeOfB) REQUIRE(other.tie == NormalTie::EdgeOfA);
    if (one.tie == NormalTie::Points) REQUIRE(other.tie == NormalTie::Points);
  }
}

TEST_CASE("a half-space heeds its own plane, not its pose") {
  const HalfSpace floor{Vec3(0.0, 0.6, 0.8), 2.0};
  const Pose anywhere = Random(33).pose(10.0);
  const Pose ball{Vec3(7.0, 3.0, 4.0), Quat::Identity()};
  const Manifold manifold = points(Sphere{1.0}, ball, floor, anywhere, 3.0);
  REQUIRE(manifold.size() == 1);
  REQUIRE(manifold[0].n == floor.n);
  REQUIRE(std::abs(manifold[0].separation - 2.0) < 1e-15);
  REQUIRE((manifold[0].p - (ball.x - 2.0 * floor.n)).norm() < 1e-15);
  REQUIRE(separation(Sphere{1.0}, ball, floor, anywhere) == manifold[0].separation);
}

TEST_CASE("a box meets a half-space with one, two or four vertices") {
  const HalfSpace floor;
  const Vec3 diagonal(1.0, 1.0, 1.0);
  const Quat onCorner = turnBetween(diagonal, Vec3::UnitY());
  const Box cube{Vec3::Constant(0.5)};
  const auto count = [&](double height, const Quat& q) {
    return points(cube, {{0.0, height, 0.0}, q}, floor, Pose{}, 1e-9).size();
  };
  REQUIRE(count(0.5, Quat::Identity()) == 4);
  REQUIRE(count(std::sqrt(0.5), turn(Vec3::UnitX(), 45.0)) == 2);
  REQUIRE(count(std::sqrt(0.75), onCorner) == 1);
  REQUIRE(count(0.5 + 2e-9, Quat::Identity()) == 0);
}

TEST_CASE("the lowest vertex of a box has exactly the separation of the box") {
  Random random(34);
  for (int k = 0; k < 1000; ++k) {
    const Box box = random.box();
    const Pose pose = random.pose(3.0);
    const HalfSpace floor{random.direction(), random.uniform(-1.0, 1.0)};
    const Manifold all = points(box, pose, floor, Pose{}, 1e9);
    REQUIRE(all.size() == 8);
    std::set<std::uint64_t> features;
    double lowest = 1e300;
    for (const ContactPoint& c : all) {
      features.insert(c.feature);
      lowest = std::min(lowest, c.separation);
      REQUIRE(std::abs(c.separation - (floor.n.dot(c.pa) - floor.d)) < 1e-14);
      REQUIRE((toBody(pose, c.pa).cwiseAbs() - box.half).norm() < 1e-14);
    }
    REQUIRE(features.size() == 8);
    REQUIRE(lowest == separation(box, pose, floor, Pose{}));
  }
}

TEST_CASE("half-spaces never collide") {
  REQUIRE_FALSE(canCollide(HalfSpace{}, HalfSpace{}));
  REQUIRE(separation(HalfSpace{}, Pose{}, HalfSpace{}, Pose{}) > 1e300);
  Manifold left(3);
  collide(HalfSpace{}, Pose{}, HalfSpace{}, Pose{}, 1e9, left);
  REQUIRE(left.empty());
}

}  // namespace
}  // namespace tumble
