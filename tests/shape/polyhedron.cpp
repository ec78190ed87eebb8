// Chapter 2, shape: which faces bound a solid.
#include "sim/shape/polyhedron.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/body/mass_properties.h"
#include "sim/body/mass_surface.h"
#include "sim/math/rotation.h"
#include "tests/body/solids.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

/// Why a surface is refused; "" if it is not.
std::string refusal(const solids::Raw& raw) {
  try {
    raw.made();
  } catch (const NotASolid& reason) {
    return reason.what();
  }
  return "";
}

/// Two surfaces in one list, the second turned inside out at will.
solids::Raw both(solids::Raw a, const solids::Raw& b, bool turned) {
  const int first = static_cast<int>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (std::vector<int> face : b.faces) {
    for (int& i : face) i += first;
    if (turned) std::reverse(face.begin() + 1, face.end());
    a.faces.push_back(face);
  }
  return a;
}

solids::Raw cube(const Vec3& lo, double edge) {
  return solids::box(lo, lo + Vec3::Constant(edge));
}

bool says(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a surface that bounds no solid is refused with the offending edge") {
  const solids::Raw cube = solids::box(Vec3::Zero(), Vec3::Ones());
  CHECK(refusal(cube).empty());

  solids::Raw open = cube;
  open.faces.pop_back();
  CHECK(says(refusal(open), "face on one side only"));
  CHECK(says(refusal(open), "the edge from point 5 (0, 0, 1) to point 7 (0, 1, 1)"));

  solids::Raw flipped = cube;
  std::reverse(flipped.faces[2].begin(), flipped.faces[2].end());
  CHECK(says(refusal(flipped), "the same way"));
  CHECK(says(refusal(flipped), "face 2 and face 3"));

  solids::Raw insideOut = cube;
  for (std::vector<int>& face : insideOut.faces) std::reverse(face.begin(), face.end());
  CHECK(says(refusal(insideOut), "inside out"));
  CHECK(says(refusal(insideOut), "the edge from point"));

  solids::Raw tripled = cube;  // a fin on an edge: three faces there
  tripled.points.emplace_back(2, 2, 2);
  tripled.faces.push_back({0, 1, 8});
  CHECK_FALSE(refusal(tripled).empty());

  solids::Raw collapsed = cube;
  collapsed.points[7] = collapsed.points[3];
  CHECK(says(refusal(collapsed), "has no length"));

  solids::Raw flat = solids::tetrahedron();
  flat.points[3] = Vec3(2.0, 0.0, 0.0);
  CHECK(says(refusal(flat), "no area"));

  // One triangle seen from either side; its volume rounds to either sign, and to 0.
  const solids::Raw sheet{{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 1, 2}, {2, 1, 0}}};
  for (const Vec3& aside : {Vec3(0, 0, 0), Vec3(0.1, 0.2, 0.7), Vec3(-0.3, 0.1, -0.9)}) {
    for (const double angle : {0.0, 0.4, 1.1, 2.9}) {
      solids::Raw there = solids::turned(sheet, fromAxisAngle(Vec3(1, 2, 3).normalized(), angle));
      for (Vec3& p : there.points) p += aside;
      CHECK(refusal(there) ==
            "the surface holds no volume, or so little that it may be rounding alone");
      for (const bool turned : {false, true})
        CHECK(
            refusal(both(cube, there, turned)) ==
            "the shell of face 7 at point 9 holds no volume, or so little that it may be rounding "
            "alone");
    }
  }

  solids::Raw missing = cube;
  missing.faces[0][0] = 8;
  CHECK(says(refusal(missing), "names point 9 of 8"));
  CHECK(says(refusal({{}, {}}), "no faces"));
}

TEST_CASE("shells that are counted twice or as less than nothing are refused") {
  const solids::Raw unit = cube(Vec3::Zero(), 1.0);
  const std::string second = "the shell of face 7 at point 9 ", first = "the shell of face 1";
  const std::string overlap =
      second + "overlaps " + first + " at point 1; what they share would be counted twice";
  CHECK(refusal(both(unit, unit, false)) == overlap);
  for (const Vec3& aside :
       {Vec3(0.5, 0.0, 0.0), Vec3(0.0, -0.5, 0.0), Vec3(0.9, 0.9, -0.8), Vec3(0.3, 0.2, 0.1)})
    for (const bool turned : {false, true})
      CHECK(refusal(both(unit, cube(aside, 0.9), turned)) == overlap);
  CHECK(refusal(both(unit, cube(Vec3(5.0, 0.0, 0.0), 0.5), true)) ==
        second + "is inside out, and no other is around it");
  CHECK(refusal(both(unit, cube(Vec3(0.25, 0.3, 0.35), 0.3), false)) ==
        second + "lies inside " + first +
            " and is counted twice; the faces of a cavity run the other way round");
  CHECK(refusal(both(cube(Vec3(0.25, 0.3, 0.35), 0.3), unit, false)) ==
        "the shell of face 1 at point 1 lies inside the shell of face 7 and is counted twice; the "
        "faces of a cavity run the other way round");
  const solids::Raw hollow = both(unit, cube(Vec3(0.1, 0.1, 0.1), 0.8), true);
  CHECK(refusal(both(hollow, cube(Vec3(0.3, 0.3, 0.3), 0.2), true)) ==
        "the shell of face 13 at point 17 is inside out, and so is the cavity around it");
}

// Oracle: volumes by hand.
TEST_CASE("shells may lie apart, touch, and bound cavities with solids in them") {
  const solids::Raw unit = cube(Vec3::Zero(), 1.0);
  const auto volume = [](const solids::Raw& raw) { return tumble::volume(raw.mesh()); };
  for (const Vec3& aside : {Vec3(5.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.0, -1.0, 0.0),
                            Vec3(1.0, 0.5, 0.5), Vec3(1.0, 1.0, 1.0), Vec3(0.0, 1.0, 0.3)})
    for (const double angle : {0.0, 0.7}) {
      const Quat tilt = fromAxisAngle(Vec3(1.0, 2.0, 3.0).normalized(), angle);
      const solids::Raw pair = solids::turned(both(unit, cube(aside, 1.0), false), tilt);
      CHECK(volume(pair) == Approx(2.0).epsilon(1e-13));
    }
  const solids::Raw hollow = both(unit, cube(Vec3(0.01, 0.01, 0.01), 0.98), true);
  CHECK(volume(hollow) == Approx(1.0 - 0.98 * 0.98 * 0.98).epsilon(1e-13));
  const solids::Raw core = both(hollow, cube(Vec3(0.3, 0.3, 0.3), 0.5), false);
  CHECK(volume(core) == Approx(1.125 - 0.98 * 0.98 * 0.98).epsilon(1e-13));
  // One ring through another: their boxes meet, they do not.
  solids::Raw ring = solids::torus(1.0, 0.3, 24, 12);
  const double one = volume(ring);
  for (Vec3& p : ring.points) p = Vec3(p.x() + 1.0, -p.z(), p.y());
  CHECK(volume(both(solids::torus(1.0, 0.3, 24, 12), ring, false)) ==
        Approx(2.0 * one).epsilon(1e-13));
}

// Oracle: areas by hand.
TEST_CASE("a face with a notch is cut into triangles inside it") {
  const Polyhedron ell = solids::ell().made();
  for (const std::vector<int>& face : ell.faces) {
    std::vector<std::array<int, 3>> triangles;
    cutIntoTriangles(ell, face, triangles);
    CHECK(triangles.size() == face.size() - 2);
    double sum = 0.0;
    for (const auto& [a, b, c] : triangles) sum += areaVector(ell, {a, b, c}).norm();
    CHECK(sum == Approx(areaVector(ell, face).norm()).epsilon(1e-14));
  }
}

TEST_CASE("faces that are not flat are cut, flat ones are kept") {
  CHECK(solids::ell().made().faces.size() == 8);
  CHECK(solids::torus(1.0, 0.3, 12, 6).made().faces.size() >= 72);
  solids::Raw bent = solids::box(Vec3::Zero(), Vec3::Ones());
  bent.points[7] += Vec3(1e-6, 0.0, 0.0);
  CHECK(bent.made().faces.size() == 7);  // of the three faces at that corner only x = 1 bends
}

// A corner that lies on the line of two others leaves a triangle without area where a face that is
// bent elsewhere is cut, which has no normal.
TEST_CASE("a bent face that leaves a triangle without area is refused") {
  const std::vector<Vec3> points{{0, 0, -0.5}, {2, 0, -0.5}, {2, 1, -0.5},    {1, 1, -0.5},
                                 {1, 2, -0.5}, {0, 2, -0.5}, {0, 0, 0.5},     {2, 0, 0.5},
                                 {2, 1, 0.5},  {1, 0, 0.5},  {1, 20.52, 1.0}, {1, 1, 0.5}};
  const std::vector<std::vector<int>> faces{{0, 1, 7, 6},         {1, 2, 8, 7},      {2, 3, 9, 8},
                                            {3, 4, 10, 9},        {4, 5, 11, 10},    {5, 0, 6, 11},
                                            {6, 7, 8, 9, 10, 11}, {5, 4, 3, 2, 1, 0}};
  CHECK(says(refusal({points, faces}), "face 7 is not flat, and one of the triangles"));
}

// Oracle: the volume integrals, which are summed in another way. Flakes of a thickness of 1e-9 to
// 1e-17 of their size, turned at random: each is refused, or has a volume that is positive.
TEST_CASE("a solid is thicker than rounding, and its points are not too far apart") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto point = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  int kept = 0, refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 a = point(), b = point(), c = point();
    const double thickness = std::pow(10.0, -9.0 - trial % 9);
    const Vec3 top = (a + b + c) / 3.0 + thickness * (b - a).cross(c - a).normalized();
    const solids::Raw flake{{a, b, c, top}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    if (refusal(flake).empty()) {
      ++kept;
      CHECK(integrate(flake.made()).volume > 0.0);
    } else {
      ++refused;
    }
  }
  CHECK(kept > 400);
  CHECK(refused > 800);

  for (const double size : {1e-60, 1e59}) CHECK(refusal(cube(Vec3::Zero(), size)).empty());
  CHECK(says(refusal(cube(Vec3::Zero(), 1e60)), "too far apart"));
}
