// What cuts leave: surfaces that hang together, and the edges at which those are not convex.
#include "sim/shape/cut.h"

#include <algorithm>
#include <cmath>

#include "sim/shape/notches.h"
#include "sim/shape/polyhedron.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

cut::Points pointsAt(const std::vector<Vec3>& at) {
  cut::Points points;
  points.at = at;
  points.exact.resize(at.size());
  return points;
}

cut::Surface surfaceOf(const Polyhedron& solid) {
  cut::Surface surface;
  std::vector<std::array<int, 3>> triangles;
  for (const std::vector<int>& face : solid.faces) cutIntoTriangles(solid, face, triangles);
  for (const auto& corner : triangles)
    surface.push_back({corner, static_cast<int>(surface.size())});
  return surface;
}

bool hasCorner(const cut::Surface& surface, int corner) {
  return std::any_of(surface.begin(), surface.end(), [&](const cut::Triangle& t) {
    return std::find(t.corner.begin(), t.corner.end(), corner) != t.corner.end();
  });
}

}  // namespace

// Oracle: areas by hand. A hole meets what is around it at one corner, from which a loop may begin:
// no triangle lies on another, or in the hole.
TEST_CASE("a hole that touches what is around it stays one") {
  const cut::Points points = pointsAt(
      {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {-2, 2, 0}, {-2, 0, 0}, {0.5, 1, 0}, {-0.5, 1, 0}});
  std::vector<std::array<int, 2>> edges = {{0, 6}, {6, 5}, {5, 0}, {0, 1},
                                           {1, 2}, {2, 3}, {3, 4}, {4, 0}};
  const bool exact = GENERATE(false, true);
  for (std::size_t first = 0; first < edges.size(); ++first) {
    double area = 0.0, size = 0.0;
    for (const auto& [corner, face] : cut::fill(points, edges, Vec3::UnitZ(), exact)) {
      const double twice = cut::turn(points, corner[0], corner[1], corner[2], 2, false);
      area += 0.5 * twice;
      size += 0.5 * std::abs(twice);
    }
    CAPTURE(exact, first);
    CHECK(area == 7.5);
    CHECK(size == 7.5);
    std::rotate(edges.begin(), edges.begin() + 1, edges.end());
  }
}

// Oracle: by construction. A fin thinner than the tolerance lies in the plane of a cut: its two
// sides stay together, on one half alone, and both halves hold what the block does there.
TEST_CASE("what is thinner than the tolerance is not cut along") {
  constexpr double kThick = 1e-7;
  const Polyhedron solid = makePolyhedron({{0, 0, -1},
                                           {1, 0, -1},
                                           {1, 1, -1},
                                           {0, 1, -1},
                                           {0, 0, 1},
                                           {1, 0, 1},
                                           {1, 1, 1},
                                           {0, 1, 1},
                                           {1, 0, -kThick},
                                           {1, 1, -kThick},
                                           {1, 0, kThick},
                                           {1, 1, kThick},
                                           {2, 0.5, 0}},
                                          {{0, 3, 2, 1},
                                           {4, 5, 6, 7},
                                           {0, 4, 7, 3},
                                           {0, 1, 8, 10, 5, 4},
                                           {2, 3, 7, 6, 11, 9},
                                           {1, 2, 9, 8},
                                           {10, 11, 6, 5},
                                           {10, 12, 11},
                                           {8, 9, 12},
                                           {8, 12, 10},
                                           {9, 11, 12}});
  constexpr int kTip = 12;
  for (const double up : {1.0, -1.0}) {
    cut::Points points = pointsAt(solid.points);
    for (Vec3& p : points.at) p -= Vec3(0, 0, 1);  // points stand off the first
    const cut::CutPlane plane = cut::planeThrough({0, 0, 0}, {1, 0, 0}, {0, up, 0});
    const cut::Halves halves = cut::halve(points, surfaceOf(solid), plane, 1e-6);
    CHECK(hasCorner(halves.below, kTip) != hasCorner(halves.above, kTip));
    for (const cut::Surface* half : {&halves.below, &halves.above})
      CHECK(cut::sixfoldVolume(points, *half) == Approx(6.0).epsilon(1e-6));
  }
}

// Oracle: by construction. Two tetrahedra have an edge in common: each is closed there without the
// other. As one they are not convex and have no notch.
TEST_CASE("surfaces that touch along an edge are apart") {
  const cut::Points points =
      pointsAt({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}});
  const auto solid = [](int a, int b, int c, int d) {
    return cut::Surface{{{a, c, b}}, {{a, b, d}}, {{b, c, d}}, {{c, a, d}}};
  };
  cut::Surface both = solid(0, 2, 3, 1);
  for (const cut::Triangle& t : solid(0, 4, 5, 1)) both.push_back(t);
  const std::vector<cut::Surface> apart = cut::pieces(points, both);
  REQUIRE(apart.size() == 2);
  for (const cut::Surface& piece : apart)
    CHECK(cut::sixfoldVolume(points, piece) == Approx(1.0).epsilon(1e-15));
}

// Oracle: by construction. Between two faces of a mesh lay a sliver, whose corners are on a cut as
// one edge: in the piece the faces are neighbours, and their planes tell how.
TEST_CASE("where a sliver is gone its neighbours make a notch, or a ridge") {
  const double rise = GENERATE(1.0, -1.0);
  const cut::Points points =
      pointsAt({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0.5, -1, rise}});
  const cut::Surface whole = {{{0, 1, 2}, 0}, {{4, 3, 5}, 1}},
                     piece = {{{0, 1, 2}, 0}, {{1, 0, 5}, 1}};
  const std::vector<int> flat = {0, 1};
  const cut::Notches notches(points, whole, flat, {.slack = 1e-6, .snap = 1e-6});
  const std::vector<cut::Notch> found = notches.of(piece);
  CHECK(found.size() == (rise > 0.0 ? 1 : 0));
  for (const cut::Notch& notch : found) CHECK(notches.planesAt(notch, found).size() == 3);
}
