// Chapter 5, collide: every kind of contact that two boxes can have, by hand.
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "tests/catch.h"
#include "tests/collide/boxes.h"

namespace tumble {
namespace {

const double kHalfSpaceDiagonal = std::sqrt(0.75);

// A cube that stands on one corner: its space diagonal is along Y.
Quat onCorner() {
  return Quat::FromTwoVectors(Vec3::Ones(), Vec3::UnitY());
}

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

}  // namespace
}  // namespace tumble
