// Chapter 5, collide: every kind of contact that two boxes can have, by hand.
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "sim/collide/contact_kind.h"
#include "sim/math/frames.h"
#include "sim/math/rotation.h"
#include "tests/catch.h"
#include "tests/collide/boxes.h"
#include "tests/collide/hulls.h"

namespace tumble {
namespace {

const double kHalfSpaceDiagonal = std::sqrt(0.75);

// A cube that stands on one corner: its space diagonal is along Y.
Quat onCorner() {
  return turnBetween(Vec3::Ones(), Vec3::UnitY());
}

struct Kind {
  const char* name;
  ContactKind kind;
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
      {"vertex on face",
       ContactKind::VertexFace,
       {kCube, kCube, at(kHalfSpaceDiagonal, onCorner()), b},
       {FaceOfB},
       {o}},
      {"face on vertex",
       ContactKind::VertexFace,
       {kCube, kCube, at(0.5, flat), bOnCorner},
       {FaceOfA},
       {o}},
      {"edge on edge, crossing",
       ContactKind::EdgeEdge,
       {kCube, kCube, at(kHalfDiagonal, onEdgeAcross), bOnEdge},
       {Edges},
       {o}},
      {"edge on face",
       ContactKind::EdgeFace,
       {kCube, kCube, at(kHalfDiagonal, onEdge), b},
       {FaceOfB},
       {{0.0, 0.0, -0.5}, {0.0, 0.0, 0.5}}},
      {"face on face",
       ContactKind::FaceFace,
       {kCube, kCube, at(0.5, flat), b},
       {FaceOfB},
       {{-0.5, 0.0, -0.5}, {-0.5, 0.0, 0.5}, {0.5, 0.0, -0.5}, {0.5, 0.0, 0.5}}},
      {"face on face, overhanging",
       ContactKind::FaceFace,
       {kCube, kCube, {{0.25, 0.5, 0.125}, flat}, b},
       {FaceOfB},
       {{-0.25, 0.0, -0.375}, {-0.25, 0.0, 0.5}, {0.5, 0.0, -0.375}, {0.5, 0.0, 0.5}}},
      {"face on face, turned by 45 degrees",
       ContactKind::FaceFace,
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
       ContactKind::EdgeEdge,
       {kCube, kCube, {{1.0, 0.5, 0.0}, flat}, b},
       {FaceOfB},
       {{0.5, 0.0, -0.5}, {0.5, 0.0, 0.5}}},
      {"face on face, sharing one corner",
       ContactKind::VertexVertex,
       {kCube, kCube, {{1.0, 0.5, 1.0}, flat}, b},
       {FaceOfB},
       {{0.5, 0.0, 0.5}}},
      {"edge on edge, parallel",
       ContactKind::EdgeEdge,
       {kCube, kCube, at(kHalfDiagonal, onEdge), bOnEdge},
       {FaceOfB, FaceOfA},
       {{0.0, 0.0, -0.5}, {0.0, 0.0, 0.5}}},
      {"vertex on vertex",
       ContactKind::VertexVertex,
       {kCube, kCube, at(kHalfSpaceDiagonal, onCorner()), bOnCorner},
       {FaceOfB, FaceOfA, Edges},
       {o}},
      {"vertex on edge",
       ContactKind::VertexEdge,
       {kCube, kCube, at(kHalfSpaceDiagonal, onCorner()), bOnEdge},
       {FaceOfB, FaceOfA, Edges},
       {o}},
      {"wide plate on post",
       ContactKind::FaceFace,
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

// Oracle: by hand. Slide question: which collisions are possible?
TEST_CASE(
    "each of the six kinds of contact is called by its name, between boxes and between hulls") {
  std::set<ContactKind> seen;
  for (const Kind& kind : kinds()) {
    CAPTURE(kind.name);
    const Boxes& s = kind.boxes;
    const Manifold manifold = s.points(1e-8);
    const ContactKind found = contactKind(s.a, s.poseA, s.b, s.poseB, manifold, 1e-8);
    CHECK(contactKindName(found) == contactKindName(kind.kind));
    seen.insert(found);

    const Shape a = boxHull(s.a.half), b = boxHull(s.b.half);
    Manifold ofHulls;
    collide(a, s.poseA, b, s.poseB, 1e-8, ofHulls);
    CHECK(sameSet(ofHulls, kind.points, 1e-14));
    CHECK(contactKind(a, s.poseA, b, s.poseB, ofHulls, 1e-8) == kind.kind);
    for (const ContactPoint& c : ofHulls) {
      CHECK(kind.ties.count(c.tie) == 1);
      CHECK(std::abs(c.separation) < 1e-14);
    }
    // Exchanged, the same contact has the same name.
    const Boxes other = s.swapped();
    const Manifold mirrored = other.points(1e-8);
    CHECK(contactKind(other.a, other.poseA, other.b, other.poseB, mirrored, 1e-8) == kind.kind);
  }
  CHECK(seen.size() == 6);
}

// Oracle: definition. Two crossing edges fix n up to its sign, which points out of b towards a.
TEST_CASE("where edges cross, n is along ea x eb, out of b towards a") {
  Random random(49);
  int crossing = 0;
  for (int k = 0; k < 4000; ++k) {
    const Boxes s{random.box(), random.box(), random.pose(0.8), random.pose(0.8)};
    const Manifold manifold = s.points(1e-3);
    if (manifold.empty() || manifold[0].tie != NormalTie::Edges) continue;
    ++crossing;
    for (const ContactPoint& c : manifold) {
      const Vec3 along = c.ea.cross(c.eb).normalized();
      const double side = along.dot(c.n);
      REQUIRE(std::abs(std::abs(side) - 1.0) < 1e-12);
      // a's corners nearest to b are b's side of the plane by no more than the overlap.
      const Vec3 down = s.poseA.q.conjugate() * -c.n, up = s.poseB.q.conjugate() * c.n;
      const double low = c.n.dot(s.poseA.x) - down.cwiseAbs().dot(s.a.half);
      const double top = c.n.dot(s.poseB.x) + up.cwiseAbs().dot(s.b.half);
      REQUIRE(std::abs((low - top) - s.gap()) < 1e-12);
    }
  }
  REQUIRE(crossing > 100);
}

}  // namespace
}  // namespace tumble
