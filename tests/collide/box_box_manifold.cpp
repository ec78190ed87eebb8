// Chapter 5, collide: what holds for the manifold of any two boxes.
#include <algorithm>
#include <cmath>

#include "sim/collide/features.h"
#include "sim/math/frames.h"
#include "tests/catch.h"
#include "tests/collide/boxes.h"

namespace tumble {
namespace {

Boxes someTouching(Random& random) {
  const Box a = random.box();
  const Box b = random.box();
  const Pose poseA = random.pose(0.7);
  const Pose poseB = random.pose(0.7);
  return {a, b, poseA, poseB};
}

// Symmetry. Points where edges cross at small angles shift most: measured 1.6e-14 m, allowed
// 2e-13 m; normals 1.6e-15, allowed 1e-14.
TEST_CASE("exchanging a and b mirrors normals, ties and features and leaves the points") {
  Random random(42);
  int compared = 0;
  for (int k = 0; k < 5000; ++k) {
    const Boxes boxes = someTouching(random);
    const Manifold one = boxes.points(0.02), other = boxes.swapped().points(0.02);
    REQUIRE(std::abs(boxes.gap() - boxes.swapped().gap()) < 1e-14);
    REQUIRE(one.size() == other.size());
    for (const ContactPoint& c : one) {
      const std::uint64_t mirrored = swappedFeature(c.feature);
      const auto twin = std::find_if(other.begin(), other.end(),
                                     [&](const ContactPoint& o) { return o.feature == mirrored; });
      REQUIRE(twin != other.end());
      REQUIRE((twin->n + c.n).norm() < 1e-14);
      REQUIRE((twin->p - c.p).norm() < 2e-13);
      REQUIRE(std::abs(twin->separation - c.separation) < 2e-13);
      const bool onFace = c.tie == NormalTie::FaceOfA || c.tie == NormalTie::FaceOfB;
      REQUIRE((twin->tie != c.tie) == onFace);
      ++compared;
    }
  }
  REQUIRE(compared > 5000);
}

// Invariance. Measured 9.4e-15 m and 1.7e-15, allowed 2e-13 m and 1e-14.
TEST_CASE("the manifold moves with the world") {
  Random random(43);
  for (int k = 0; k < 2000; ++k) {
    const Boxes boxes = someTouching(random);
    const Pose motion = random.pose(3.0);
    const Manifold before = boxes.points(0.02), after = boxes.movedBy(motion).points(0.02);
    REQUIRE(before.size() == after.size());
    for (std::size_t m = 0; m < before.size(); ++m) {
      REQUIRE(before[m].feature == after[m].feature);
      REQUIRE((toWorld(motion, before[m].p) - after[m].p).norm() < 2e-13);
      REQUIRE((motion.q * before[m].n - after[m].n).norm() < 1e-14);
    }
  }
}

// Oracle: sampling. Seen along n, a point of b's face belongs to the contact region if the line
// along n through it meets a's face; the manifold must be the corners of just that region.
TEST_CASE("the points of a face contact are the corners of the region that both faces share") {
  Random random(44);
  int within = 0, without = 0;
  for (int k = 0; k < 400; ++k) {
    Boxes boxes = someTouching(random);
    const Vec3 tilt = random.direction();
    boxes.poseA.q = turn(tilt, random.uniform(0.0, 10.0));
    boxes.poseA.x.y() = boxes.poseB.x.y() + boxes.a.half.y() + boxes.b.half.y() + 0.1;
    boxes.poseB.q = turn(Vec3::UnitY(), random.uniform(0.0, 360.0));
    const Manifold corners = boxes.points(1e9);
    if (corners.size() < 3 || corners[0].tie != NormalTie::FaceOfB) continue;
    const Vec3 n = corners[0].n;
    if (n.y() < 0.99) continue;

    const double top = boxes.poseB.x.y() + boxes.b.half.y();
    const Vec3 down_A = boxes.poseA.q.conjugate() * Vec3::UnitY();
    for (int m = 0; m < 200; ++m) {
      Vec3 p_B = random.vector(-1.0, 1.0).cwiseProduct(boxes.b.half);
      p_B.y() = boxes.b.half.y();
      const Vec3 p = toWorld(boxes.poseB, p_B);
      // The line p + t Y meets the plane y_A = −half of a's lower face at t.
      Vec3 p_A = toBody(boxes.poseA, p);
      p_A += (-boxes.a.half.y() - p_A.y()) / down_A.y() * down_A;
      const bool shared =
          std::abs(p_A.x()) <= boxes.a.half.x() && std::abs(p_A.z()) <= boxes.a.half.z();

      // In the hull of the corners: no line through two of them has all others on its far side.
      bool inHull = true;
      for (const ContactPoint& c : corners) {
        for (const ContactPoint& e : corners) {
          const Vec3 side = (e.pb - c.pb).cross(Vec3::UnitY());
          const bool outline = std::all_of(corners.begin(), corners.end(), [&](const auto& o) {
            return side.dot(o.pb - c.pb) <= 1e-12;
          });
          if (side.norm() > 1e-9 && outline && side.dot(p - c.pb) > 1e-9) inHull = false;
        }
      }
      REQUIRE(inHull == shared);
      REQUIRE(std::abs(corners[0].pb.y() - top) < 1e-14);
      ++(shared ? within : without);
    }
  }
  CAPTURE(within, without);
  REQUIRE(within > 2000);
  REQUIRE(without > 2000);
}

Quat latticeRotation(Random& random) {
  const int axis = random.below(3);
  const int eighths = random.below(8);
  return turn(Vec3::Unit(axis), 45.0 * eighths);
}

// Poses on a lattice make coplanar faces, parallel edges and coincident vertices common.
TEST_CASE("boxes that touch or overlap have at least one point, however degenerate the pose") {
  Random random(45);
  int touching = 0;
  for (int k = 0; k < 50000; ++k) {
    const double reach = 4.0;
    const Vec3 lattice = (random.vector(-reach, reach).array().round() * 0.5).matrix();
    const Quat qa = latticeRotation(random);
    const Quat qb = latticeRotation(random);
    const double grown = k % 2 ? std::sqrt(0.5) : 1.0;
    const Boxes boxes{kCube, kCube, {grown * lattice, qa}, {Vec3::Zero(), qb}};
    const double gap = boxes.gap();
    const Manifold manifold = boxes.points(1e-9);
    if (gap <= 1e-12) {
      ++touching;
      REQUIRE_FALSE(manifold.empty());
    }
    for (const ContactPoint& c : manifold) {
      REQUIRE(std::abs(c.n.norm() - 1.0) < 1e-14);
      REQUIRE(c.separation >= gap - 1e-9);
      REQUIRE((c.pa - c.pb - c.separation * c.n).norm() < 1e-14);
    }
  }
  REQUIRE(touching > 5000);
}

// With a wide margin the nearest features may be two vertices, or a vertex and an edge.
TEST_CASE("boxes that are apart have their nearest features as points within the margin") {
  const Boxes corners{kCube, kCube, {{1.1, 1.2, 1.2}, Quat::Identity()}, Pose{}};
  const Manifold one = corners.points(0.5);
  REQUIRE(one.size() == 1);
  REQUIRE(one[0].tie == NormalTie::Points);
  REQUIRE((one[0].n - Vec3(1.0, 2.0, 2.0) / 3.0).norm() < 1e-14);
  REQUIRE(std::abs(one[0].separation - 0.3) < 1e-14);
  REQUIRE((one[0].p - Vec3(0.55, 0.6, 0.6)).norm() < 1e-14);
  REQUIRE(corners.points(0.29).empty());

  const Boxes edges{kCube, kCube, {{1.03, 1.04, 0.25}, Quat::Identity()}, Pose{}};
  const Manifold two = edges.points(0.05 + 1e-12);
  REQUIRE(two.size() == 2);
  for (const ContactPoint& c : two) {
    REQUIRE((c.n - Vec3(0.6, 0.8, 0.0)).norm() < 1e-12);
    REQUIRE(std::abs(c.separation - 0.05) < 1e-14);
    const bool ofA = c.tie == NormalTie::EdgeOfA;
    REQUIRE((ofA || c.tie == NormalTie::EdgeOfB));
    REQUIRE((ofA ? c.ea : c.eb).cwiseAbs() == Vec3::UnitZ());
  }
}

// Oracle: duality. Points of both boxes at the distance of a slab that separates the boxes are
// nearest points. Measured 8.9e-16 m, allowed 1e-13 m. Nearly aligned boxes far apart, where also
// edges that cross at small angles count.
TEST_CASE("where n is tied to vertices, or to a vertex and an edge, they are the nearest of all") {
  Random random(48);
  int vertices = 0, edges = 0;
  double worst = 0.0;
  for (int k = 0; k < 100000; ++k) {
    const Box a = random.box();
    const Box b = random.box();
    Boxes boxes{a, b, {random.vector(-1.5, 1.5), Quat::Identity()}, Pose{}};
    const Vec3 axis = random.direction();
    boxes.poseA.q = turn(axis, random.uniform(1.0, 50.0));
    if (boxes.gap() <= 0.0) continue;
    const ContactPoint c = boxes.points(10.0).at(0);
    if (c.tie == NormalTie::FaceOfA || c.tie == NormalTie::FaceOfB) continue;
    if (c.tie == NormalTie::Edges) continue;
    ++(c.tie == NormalTie::Points ? vertices : edges);
    const Vec3 nA = boxes.poseA.q.conjugate() * c.n;
    const double slab =
        c.n.dot(boxes.poseA.x) - nA.cwiseAbs().dot(boxes.a.half) - c.n.cwiseAbs().dot(boxes.b.half);
    worst = std::max(worst, std::abs(slab - c.separation));
  }
  CAPTURE(vertices, edges, worst);
  REQUIRE(vertices > 1000);
  REQUIRE(edges > 1000);
  REQUIRE(worst < 1e-13);
}

// A stacked box that trembles and creeps keeps the names of its points.
TEST_CASE("features survive small motions") {
  Random random(46);
  const Boxes stack{kCube, kCube, {{0.2, 1.0, 0.1}, turn(Vec3::UnitY(), 10.0)}, Pose{}};
  const Manifold first = stack.points(1e-3);
  REQUIRE(first.size() == 4);
  for (int k = 0; k < 1000; ++k) {
    Boxes later = stack;
    later.poseA.x += 1e-6 * random.vector(-1.0, 1.0);
    const Vec3 axis = random.direction();
    later.poseA.q = (turn(axis, 1e-5) * stack.poseA.q).normalized();
    const Manifold now = later.points(1e-3);
    REQUIRE(now.size() == first.size());
    for (std::size_t m = 0; m < now.size(); ++m) REQUIRE(now[m].feature == first[m].feature);
  }
}

// On its edge at 45° two faces of a box are equally near; rounding must not choose between them.
TEST_CASE("a box that balances on an edge does not change its far points by rounding") {
  Random random(47);
  const Boxes level{kCube, kCube, {{0.0, 0.5 + kHalfDiagonal, 0.0}, turn(Vec3::UnitZ(), 45.0)}, {}};
  const Manifold first = level.points(10.0);
  REQUIRE(first.size() == 4);
  for (int k = 0; k < 100; ++k) {
    Boxes later = level;
    const double degrees = random.uniform(-1e-9, 1e-9);
    later.poseA.q = turn(Vec3::UnitZ(), 45.0 + degrees);
    const Manifold now = later.points(10.0);
    REQUIRE(now.size() == first.size());
    for (std::size_t m = 0; m < now.size(); ++m) REQUIRE(now[m].feature == first[m].feature);
  }
}

}  // namespace
}  // namespace tumble
