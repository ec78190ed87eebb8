// Chapter 5, collide: the manifold of two boxes, kind by kind and against sampling.
#include <algorithm>
#include <cmath>
#include <set>

#include "sim/collide/collide.h"
#include "tests/catch.h"
#include "tests/collide/random_pose.h"

namespace tumble {
namespace {

const Box kCube{Vec3::Constant(0.5)};
const double kHalfDiagonal = std::sqrt(0.5), kHalfSpaceDiagonal = std::sqrt(0.75);

// A cube that stands on one corner: its space diagonal is along Y.
Quat onCorner() {
  return Quat::FromTwoVectors(Vec3::Ones(), Vec3::UnitY());
}

struct Boxes {
  Box a, b;
  Pose poseA, poseB;
  double gap() const { return separation(a, poseA, b, poseB); }
  Manifold points(double margin) const {
    Manifold manifold;
    collide(a, poseA, b, poseB, margin, manifold);
    return manifold;
  }
  Boxes swapped() const { return {b, a, poseB, poseA}; }
  Boxes movedBy(const Pose& motion) const {
    return {a, b, moved(motion, poseA), moved(motion, poseB)};
  }
};

struct Kind {
  const char* name;
  Boxes boxes;  // a above b along Y, touching
  std::set<NormalTie> ties;
  std::vector<Vec3> points;  // where they touch
};

// Contact of every kind that two boxes can have. In each a stands on top of b at the origin.
std::vector<Kind> kinds() {
  const Quat flat = Quat::Identity(), quarter = turn(Vec3::UnitY(), 90.0);
  const Quat onEdge = turn(Vec3::UnitZ(), 45.0), onEdgeAcross = quarter * onEdge;
  const Pose b{{0.0, -0.5, 0.0}, flat}, bOnEdge{{0.0, -kHalfDiagonal, 0.0}, onEdge};
  const Pose bOnCorner{{0.0, -kHalfSpaceDiagonal, 0.0}, onCorner()};
  const auto at = [](double y, const Quat& q) { return Pose{{0.0, y, 0.0}, q}; };
  const Vec3 o = Vec3::Zero();
  const double s = std::sqrt(0.5) - 0.5;  // where the outlines of two squares at 45° cross
  using enum NormalTie;
  return {
      {"vertex on face", {kCube, kCube, at(kHalfSpaceDiagonal, onCorner()), b}, {FaceOfB}, {o}},
      {"face on vertex", {kCube, kCube, at(0.5, flat), bOnCorner}, {FaceOfA}, {o}},
      {"edge on edge, crossing",
       {kCube, kCube, at(kHalfDiagonal, onEdgeAcross), bOnEdge},
       {Edges},
       {o}},
      {"edge on face",
       {kCube, kCube, at(kHalfDiagonal, onEdge), b},
       {FaceOfB},
       {{0.0, 0.0, -0.5}, {0.0, 0.0, 0.5}}},
      {"face on face",
       {kCube, kCube, at(0.5, flat), b},
       {FaceOfB},
       {{-0.5, 0.0, -0.5}, {-0.5, 0.0, 0.5}, {0.5, 0.0, -0.5}, {0.5, 0.0, 0.5}}},
      {"face on face, overhanging",
       {kCube, kCube, {{0.25, 0.5, 0.125}, flat}, b},
       {FaceOfB},
       {{-0.25, 0.0, -0.375}, {-0.25, 0.0, 0.5}, {0.5, 0.0, -0.375}, {0.5, 0.0, 0.5}}},
      {"face on face, turned by 45 degrees",
       {kCube, kCube, at(0.5, turn(Vec3::UnitY(), 45.0)), b},
       {FaceOfB},
       {{-0.5, 0.0, -s},
        {-0.5, 0.0, s},
        {0.5, 0.0, -s},
        {0.5, 0.0, s},
        {-s, 0.0, -0.5},
        {-s, 0.0, 0.5},
        {s, 0.0, -0.5},
        {s, 0.0, 0.5}}},
      {"face on face, sharing one edge of their outlines",
       {kCube, kCube, {{1.0, 0.5, 0.0}, flat}, b},
       {FaceOfB},
       {{0.5, 0.0, -0.5}, {0.5, 0.0, 0.5}}},
      {"face on face, sharing one corner",
       {kCube, kCube, {{1.0, 0.5, 1.0}, flat}, b},
       {FaceOfB},
       {{0.5, 0.0, 0.5}}},
      {"edge on edge, parallel",
       {kCube, kCube, at(kHalfDiagonal, onEdge), bOnEdge},
       {FaceOfB, FaceOfA},
       {{0.0, 0.0, -0.5}, {0.0, 0.0, 0.5}}},
      {"vertex on vertex",
       {kCube, kCube, at(kHalfSpaceDiagonal, onCorner()), bOnCorner},
       {FaceOfB, FaceOfA, Edges},
       {o}},
      {"wide plate on post",
       {Box{{3.0, 0.1, 3.0}}, kCube, at(0.1, turn(Vec3::UnitY(), 30.0)), b},
       {FaceOfB},
       {{-0.5, 0.0, -0.5}, {-0.5, 0.0, 0.5}, {0.5, 0.0, -0.5}, {0.5, 0.0, 0.5}}},
  };
}

// Each expected point is there, and no other.
bool sameSet(const Manifold& manifold, const std::vector<Vec3>& expected, double tolerance) {
  if (manifold.size() != expected.size()) return false;
  return std::all_of(expected.begin(), expected.end(), [&](const Vec3& e) {
    return std::any_of(manifold.begin(), manifold.end(),
                       [&](const ContactPoint& c) { return (c.p - e).norm() <= tolerance; });
  });
}

bool separates(const Boxes& boxes, const Vec3& n) {
  Boxes apart = boxes;
  apart.poseA.x += 1e-3 * n;
  return apart.gap() > boxes.gap() + 0.5e-3 / std::sqrt(3.0);
}

void expectKind(const Kind& kind, const Pose& motion, double tolerance) {
  CAPTURE(kind.name);
  const Boxes boxes = kind.boxes.movedBy(motion);
  std::vector<Vec3> expected;
  for (const Vec3& p : kind.points) expected.push_back(toWorld(motion, p));
  const Manifold manifold = boxes.points(1e-8);
  REQUIRE(sameSet(manifold, expected, tolerance));
  for (const ContactPoint& c : manifold) {
    REQUIRE(kind.ties.count(c.tie) == 1);
    REQUIRE(std::abs(c.separation) <= tolerance);
    REQUIRE(separates(boxes, c.n));
  }
}

// Oracle: geometry by hand. Measured 4.6e-16 m, allowed 1e-14 m.
TEST_CASE("every kind of contact has its points, where they are, and its tie") {
  for (const Kind& kind : kinds()) expectKind(kind, Pose{}, 1e-14);
}

// Coordinates up to 6 m. Measured 1.6e-15 m, allowed 2e-14 m.
TEST_CASE("every kind of contact is the same in a turned and shifted world") {
  Random random(41);
  for (int k = 0; k < 20; ++k) {
    const Pose motion = random.pose(5.0);
    for (const Kind& kind : kinds()) expectKind(kind, motion, 2e-14);
  }
}

// One ulp of 1e6 m is 1.2e-10 m, to which the positions of both bodies are rounded. Measured
// 6.5e-11 m, allowed 4e-10 m.
TEST_CASE("every kind of contact is the same a thousand kilometres away") {
  const Pose far{{1e6, -1e6, 1e6}, Quat::Identity()};
  for (const Kind& kind : kinds()) expectKind(kind, far, 4e-10);
}

TEST_CASE(
    "boxes that kiss to within rounding, or are cut into or held off by it, keep their points") {
  for (const Kind& kind : kinds()) {
    for (const double off : {-1e-12, -1e-15, -1e-16, 1e-16, 1e-15, 1e-12}) {
      expectKind(kind, Pose{}, 1e-14);
      Kind kissing = kind;
      kissing.boxes.poseA.x.y() += off;
      expectKind(kissing, Pose{}, 2e-12);
    }
  }
}

TEST_CASE("n rides on the face that its tie names, and along the edges that it names") {
  for (const Kind& kind : kinds()) {
    CAPTURE(kind.name);
    for (const ContactPoint& c : kind.boxes.points(1e-8)) {
      const Vec3 onA = toBody(kind.boxes.poseA, c.pa).cwiseAbs() - kind.boxes.a.half;
      const Vec3 onB = toBody(kind.boxes.poseB, c.pb).cwiseAbs() - kind.boxes.b.half;
      REQUIRE(onA.maxCoeff() < 1e-9);
      REQUIRE(onB.maxCoeff() < 1e-9);
      const Vec3 nA = kind.boxes.poseA.q.conjugate() * c.n;
      const Vec3 nB = kind.boxes.poseB.q.conjugate() * c.n;
      if (c.tie == NormalTie::FaceOfA) REQUIRE(nA.cwiseAbs().maxCoeff() > 1.0 - 1e-15);
      if (c.tie == NormalTie::FaceOfB) REQUIRE(nB.cwiseAbs().maxCoeff() > 1.0 - 1e-15);
      if (c.tie == NormalTie::Edges) {
        const Vec3 along = c.ea.cross(c.eb).normalized();
        REQUIRE(std::min((c.n - along).norm(), (c.n + along).norm()) < 1e-14);
      }
    }
  }
}

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
      const std::uint32_t mirrored = (c.feature & 255u) << 8 | c.feature >> 8;
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

}  // namespace
}  // namespace tumble
