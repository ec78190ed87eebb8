// What cuts leave: surfaces that hang together, and the edges at which those are not convex.
#include "sim/shape/cut.h"

#include "sim/shape/notches.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

cut::Points pointsAt(const std::vector<Vec3>& at) {
  cut::Points points;
  points.at = at;
  points.exact.resize(at.size());
  return points;
}

}  // namespace

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
