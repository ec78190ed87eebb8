// Faces that lie in one plane are one, and a mesh comes apart the same however they were cut.
#include "sim/shape/flat_faces.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/shape/pieces.h"
#include "tests/body/notched.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

constexpr double kTurn = 2.0 * 3.14159265358979323846;

/// A wheel of `teeth`, 2 m across, whose two sides are fans about their middles: points that are no
/// corners.
solids::Raw wheel(int teeth) {
  solids::Raw raw;
  const int rim = 4 * teeth;
  for (const double z : {-0.1, 0.1}) {
    for (int i = 0; i < rim; ++i) {
      const double part[] = {0.0, 0.3, 0.42, 0.88}, r = i % 4 < 2 ? 0.88 : 1.0;
      const double a = kTurn * (i / 4 + part[i % 4]) / teeth;
      raw.points.emplace_back(r * std::cos(a), r * std::sin(a), z);
    }
    raw.points.emplace_back(0.0, 0.0, z);
  }
  for (int i = 0; i < rim; ++i) {
    const int j = (i + 1) % rim, up = rim + 1;
    raw.faces.push_back({i, j, up + j, up + i});
    raw.faces.push_back({j, i, rim});
    raw.faces.push_back({up + i, up + j, up + rim});
  }
  return raw;
}

std::size_t pointsOf(const std::vector<std::vector<int>>& faces) {
  std::set<int> points;
  for (const std::vector<int>& face : faces) points.insert(face.begin(), face.end());
  return points.size();
}

}  // namespace

// Oracle: by construction. What stays are the sides and the corners of the wheel; each face is told
// by one that it is made of.
TEST_CASE("triangles of one plane are one face, without the points inside it") {
  const Polyhedron mesh = wheel(9).made();
  const FlatFaces flat = flatFacesOf(mesh, 1e-12);
  CHECK(flat.faces.size() == 38);
  CHECK(pointsOf(flat.faces) == 72);
  REQUIRE(flat.first.size() == flat.faces.size());
  for (std::size_t f = 0; f < flat.faces.size(); ++f) {
    const std::vector<int>& given = mesh.faces[static_cast<std::size_t>(flat.first[f])];
    const Vec3 n = areaVector(mesh, given).normalized();
    const Vec3 area = areaVector(mesh, flat.faces[f]);
    CHECK((area / area.norm() - n).norm() < 1e-12);
  }
}

// Oracle: by construction. Around the hole of a frame stay the triangles that it was made of.
TEST_CASE("a face with a hole stays in parts") {
  solids::Raw frame;
  for (const double z : {0.0, 1.0})
    for (const double half : {1.0, 2.0})
      for (int k = 0; k < 4; ++k)
        frame.points.emplace_back(half * (k == 1 || k == 2 ? 1 : -1), half * (k < 2 ? -1 : 1), z);
  for (int k = 0; k < 4; ++k) {
    const int l = (k + 1) % 4;
    frame.faces.push_back({k, l, 8 + l, 8 + k});  // of the hole
    std::reverse(frame.faces.back().begin(), frame.faces.back().end());
    frame.faces.push_back({4 + k, 4 + l, 12 + l, 12 + k});  // outside
    frame.faces.push_back({4 + l, 4 + k, k, l});            // below
    frame.faces.push_back({12 + k, 12 + l, 8 + l, 8 + k});  // above
  }
  const Polyhedron mesh = frame.made();
  CHECK(flatFacesOf(mesh, 1e-12).faces.size() == mesh.faces.size());
}

// Oracle: the wheel as it stands, which comes apart into its teeth and the rest. Turned, every edge
// of the fans was a notch by rounding, and it was refused.
TEST_CASE("a toothed wheel comes apart alike, however it is turned or rounded") {
  constexpr int kTeeth = 50;
  const solids::Raw straight = wheel(kTeeth);
  const Quat way(Eigen::AngleAxisd(0.7, Vec3(0.3, 0.8, 0.52).normalized()));
  for (const double grain : {0.0, 1e-4}) {
    solids::Raw raw = turned(straight, way);
    if (grain > 0.0)
      for (Vec3& p : raw.points) p = grain * (p / grain).array().round().matrix();
    const Pieces pieces = piecesOf(raw.made(), PieceKind::Good, 2e-6, grain);
    CAPTURE(grain);
    WARN("a wheel of 50 teeth, rounded to " << grain << " m: measured " << pieces.hulls.size()
                                            << " pieces, " << pieces.excess << " m out of it");
    CHECK(pieces.hulls.size() <= 2 * kTeeth + 1);
    CHECK(pieces.excess < std::max(2e-6, 6.0 * grain));
  }
}

// Oracle: by construction, a piece for each side and the bottom, and few more. Of a straight cup
// all faces are flat as they are written, in millimetres, and its inner corners miss cuts along the
// outer sides by some of the last digits; those of one that widens are bent.
TEST_CASE("cups of few decimals come apart") {
  struct Cup {
    int sides;
    double grain, foot;  // [mm] last digit; radius below, of 50 above
  };
  const auto [sides, grain, foot] =
      GENERATE(Cup{32, 1e-5, 50.0}, Cup{64, 1e-3, 35.0}, Cup{64, 1e-4, 35.0});
  const double r[] = {foot, 50.0, 46.0, foot - 3.5}, y[] = {0.0, 80.0, 80.0, 4.0};
  solids::Raw cup;
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < sides; ++i) {
      const double a = kTurn * i / sides;
      const Vec3 p(r[k] * std::cos(a), y[k], -r[k] * std::sin(a));
      cup.points.push_back(grain * (p / grain).array().round().matrix());
    }
  cup.faces.resize(2);  // the bottom, seen from above and from below
  for (int i = 0; i < sides; ++i) {
    const int j = (i + 1) % sides;
    for (int k = 0; k < 3; ++k) {
      const int at = k * sides, up = at + sides;
      cup.faces.push_back({at + i, at + j, up + j, up + i});
    }
    cup.faces[0].push_back(3 * sides + i);
    cup.faces[1].push_back(sides - 1 - i);
  }
  CAPTURE(sides, grain, foot);
  const Pieces pieces = piecesOf(cup.made(), PieceKind::Good, 7e-5, grain);
  WARN("a cup of " << sides << " sides: measured " << pieces.hulls.size() << " pieces, "
                   << pieces.excess << " out of it");
  CHECK(pieces.hulls.size() <= static_cast<std::size_t>(sides) + 8);
  CHECK(pieces.excess < std::max(7e-5, kRoughPieces * grain));
}

// Oracle: by construction, a piece for each side of each ring. To all that the digits leave open, a
// rest that leans by less than it is parted by no plane; to half of it there is none. Cuts anywhere
// make more than are allowed.
TEST_CASE("a round bowl in metres of four decimals comes apart") {
  constexpr int kSides = 20, kRings = 6;
  constexpr double kGrain = 1e-4, kRadius = 0.1, kThick = 0.008;  // m
  solids::Raw bowl;
  const auto add = [&](double r, double angle, double turn) {
    const Vec3 p(r * std::sin(angle) * std::cos(turn), -r * std::cos(angle),
                 -r * std::sin(angle) * std::sin(turn));
    bowl.points.push_back(kGrain * (p / kGrain).array().round().matrix());
  };
  // Outside from below, then inside: a pole, and rings up to the rim.
  for (const double r : {kRadius, kRadius - kThick}) {
    add(r, 0.0, 0.0);
    for (int k = 1; k <= kRings; ++k)
      for (int i = 0; i < kSides; ++i) add(r, 0.25 * kTurn * k / kRings, kTurn * i / kSides);
  }
  const auto at = [](int side, int k, int i) {
    return side * (1 + kRings * kSides) + (k == 0 ? 0 : 1 + (k - 1) * kSides + i % kSides);
  };
  for (int i = 0; i < kSides; ++i) {
    for (int k = 0; k < kRings; ++k)
      for (const int side : {0, 1}) {
        const int from = side == 0 ? i : i + 1, to = side == 0 ? i + 1 : i;
        std::vector<int> face = {at(side, k, from)};
        if (k > 0) face.push_back(at(side, k, to));
        face.push_back(at(side, k + 1, to));
        face.push_back(at(side, k + 1, from));
        bowl.faces.push_back(face);
      }
    bowl.faces.push_back(
        {at(0, kRings, i), at(0, kRings, i + 1), at(1, kRings, i + 1), at(1, kRings, i)});
  }
  const Pieces pieces = piecesOf(bowl.made(), PieceKind::Good, 1e-7, kGrain);
  WARN("a bowl of " << kSides * kRings << " sides: measured " << pieces.hulls.size() << " pieces, "
                    << pieces.excess << " m out of it");
  CHECK(pieces.hulls.size() <= kSides * kRings);
  CHECK(pieces.excess < kRoughPieces * kGrain);
}
