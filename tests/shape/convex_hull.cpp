// Chapter 2, shape: the convex hull of points. tests/oracle holds it to the exact one of CGAL.
#include "sim/shape/convex_hull.h"

#include "tests/shape/hull_points.h"

using namespace tumble;
using namespace tumble::test;

namespace {

std::string hullRefusal(const Points& points) {
  try {
    convexHull(points);
  } catch (const NotASolid& reason) {
    return reason.what();
  }
  return "";
}

}  // namespace

// Oracle: invariant. A hull is closed, its corners are points given and none of these is outside.
// No two faces of points at random are in one plane: all are triangles.
TEST_CASE("the hull of points in a cube, in a ball and on a sphere is closed and holds them",
          "[figures]") {
  PointDraw draw(1);
  double outside = 0.0;
  const auto hold = [&](const Points& points) {
    const ClosedHull closed = closedHull(points);
    CHECK(closed.hull.faces.size() == 2 * closed.hull.points.size() - 4);
    outside = std::max(outside, closed.outside);
  };
  for (const int count : {4, 5, 6, 8, 12, 40, 200}) {
    hold(many(count, [&] { return draw.cube(); }));
    hold(many(count, [&] { return draw.ball(); }));
    hold(many(count, [&] { return Vec3(draw.ball().normalized()); }));
  }
  WARN("convex hull: a point outside by measured " << outside << " of the size");
  CHECK(outside < 1e-15);
}

// Oracle: a cube has 8 corners and 6 faces, however many points lie in its faces and on its edges,
// and however it stands: then rounding bends its faces. Measured outside: 1e-16 of the size; far
// away 2e-16 of the distance.
TEST_CASE("points on a grid have a hull of six squares, turned and far away too") {
  for (const Vec3& way : {Vec3(0, 0, 0), Vec3(1e3, -2e4, 3e5)})
    for (const int n : {2, 3, 6}) {
      CAPTURE(way, n);
      const double allowed = 1e-12 + 1e-15 * way.norm();
      for (const Points& points : {grid(n), turned(grid(n), way)}) {
        const ClosedHull closed = closedHull(points);
        CHECK(closed.hull.points.size() == 8);
        CHECK(closed.hull.faces.size() == 6);
        CHECK(closed.outside <= allowed);
        CHECK(std::abs(integrate(closed.hull).volume / std::pow(n - 1, 3) - 1.0) <= 10.0 * allowed);
      }
    }
}

TEST_CASE("the faces of a prism with many sides are polygons") {
  Points points;
  for (int i = 0; i < 24; ++i)
    for (const double y : {-1.0, 0.0, 1.0})
      points.emplace_back(std::cos(EIGEN_PI * i / 12), y, std::sin(EIGEN_PI * i / 12));
  const ClosedHull closed = closedHull(turned(points, Vec3(1, 2, 3)));
  CHECK(closed.hull.points.size() == 48);
  CHECK(closed.hull.faces.size() == 26);
  CHECK(closed.outside < 1e-15);
}

// Down to what is refused. The normal of a face 3e-9 wide errs by 3e-11 even in long doubles;
// measured 1.1e-11.
TEST_CASE("nearly flat and thin hulls are closed and hold their points", "[figures]") {
  PointDraw draw(2);
  double outside = 0.0;
  for (const double thin : {1e-2, 1e-4, 1e-6, 3e-9})
    for (const Vec3& scale : {Vec3(1, 1, thin), Vec3(1, thin, thin)})
      for (int trial = 0; trial < 10; ++trial) {
        CAPTURE(scale, trial);
        const Points points = thinned(draw, trial % 2 ? 8 : 100, scale);
        const ClosedHull closed = closedHull(trial % 4 < 2 ? points : turned(points, Vec3::Zero()));
        outside = std::max(outside, closed.outside);
      }
  WARN("thin hulls: a point outside by measured " << outside << " of the size");
  CHECK(outside < 5e-11);
}

// The hardest for a hull.
TEST_CASE("points within a unit in the last place of the faces of a cube have a closed hull") {
  PointDraw draw(3);
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    const ClosedHull closed = closedHull(nearGrid(draw, 2 + trial % 3));
    CHECK(closed.outside < 1e-12);
    CHECK(closed.hull.faces.size() <= 26);
  }
}

TEST_CASE("copies and the order of the points leave a hull as it is") {
  PointDraw draw(4);
  Points points = many(50, [&] { return draw.cube(); });
  const Polyhedron once = convexHull(points);
  Points twice = points;
  twice.insert(twice.end(), points.begin(), points.end());
  CHECK(convexHull(twice).points == once.points);
  std::reverse(points.begin() + 1, points.end());
  const Polyhedron back = convexHull(points);
  CHECK(back.points.size() == once.points.size());
  CHECK(std::abs(integrate(back).volume - integrate(once).volume) < 1e-14);
}

TEST_CASE("points that span no volume are refused, saying why") {
  const auto says = [](const Points& points, const char* part) {
    CAPTURE(hullRefusal(points));
    return hullRefusal(points).find(part) != std::string::npos;
  };
  const Vec3 o = Vec3::Zero(), x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  CHECK(says({o, x, y}, "four points or more, found 3"));
  CHECK(says({o, o, o, o, o}, "one place"));
  CHECK(says({o, x, 2 * x, 3 * x, o}, "on a line"));
  CHECK(says({o, x, y, x + y, 0.5 * x}, "in a plane"));
  CHECK(says({o, x, y, x + y + 0.9e-9 * z}, "in a plane"));
  CHECK(says({o, x, y, x + y + Vec3(0, 0, std::nan(""))}, "point 4 is not finite"));
  CHECK(hullRefusal({o, x, y, x + y + 1e-8 * z}).empty());
  CHECK(hullRefusal({o, x, y, z}).empty());
  const Vec3 far(1e6, 1e6, 1e6);
  CHECK(hullRefusal({far, far + x, far + y, far + z, far}).empty());
  CHECK(says({-1e308 * x, 1e308 * x, y, z}, "too far apart"));
  CHECK(hullRefusal({1e-200 * x, o, 1e-200 * y, 1e-200 * z, 1e-320 * z}).empty());
  CHECK(hullRefusal({1e200 * x, o, 1e200 * y, 1e200 * z, 1e-320 * z}).empty());
}
