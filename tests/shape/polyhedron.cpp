// Chapter 2, shape: which faces bound a solid.
#include "sim/shape/polyhedron.h"

#include <algorithm>

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

  solids::Raw missing = cube;
  missing.faces[0][0] = 8;
  CHECK(says(refusal(missing), "names point 9 of 8"));
  CHECK(says(refusal({{}, {}}), "no faces"));
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
