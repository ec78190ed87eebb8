// The convex hull of points against the hull that CGAL finds exactly.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <array>
#include <set>

#include "tests/shape/hull_points.h"

using namespace tumble;
using namespace tumble::test;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Place = std::array<double, 3>;

Place placeOf(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

struct Reference {
  std::set<Place> corners;
  double volume = 0.0;
};

/// Of the points less the first, as `convexHull` takes them.
Reference exactHull(const Points& given) {
  std::vector<Kernel::Point_3> points;
  for (const Vec3& p : given) {
    const Vec3 q = p - given[0];
    points.emplace_back(q.x(), q.y(), q.z());
  }
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  CGAL::convex_hull_3(points.begin(), points.end(), surface);
  Reference hull;
  const auto vec = [&](auto v) {
    const auto& p = surface.point(v);
    return Vec3(p.x(), p.y(), p.z());
  };
  for (const auto v : surface.vertices()) hull.corners.insert(placeOf(vec(v)));
  for (const auto f : surface.faces()) {
    Points t;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) t.push_back(vec(v));
    hull.volume += t[0].dot(t[1].cross(t[2])) / 6.0;
  }
  return hull;
}

struct Compared {
  std::size_t missing;  ///< corners of the exact hull that ours leaves out
  double volume;        ///< off the exact one, relative
};

/// Each corner of ours one that CGAL has.
Compared compare(const Points& given) {
  const Polyhedron hull = closedHull(given).hull;
  const Reference exact = exactHull(given);
  for (const Vec3& p : hull.points) CHECK(exact.corners.count(placeOf(p)) == 1);
  return {exact.corners.size() - hull.points.size(),
          std::abs(integrate(hull).volume / exact.volume - 1.0)};
}

}  // namespace

// Oracle: CGAL::convex_hull_3, exact. No two faces of points at random are in one plane, so the
// corners must be the same; volumes differ by the order of their sums, measured 2e-15.
TEST_CASE("the hull of points in a cube, in a ball and on a sphere has the exact corners",
          "[long][figures]") {
  PointDraw draw(1);
  double volume = 0.0;
  const auto hold = [&](const Points& points) {
    const Compared compared = compare(points);
    CHECK(compared.missing == 0);
    volume = std::max(volume, compared.volume);
  };
  for (const int count : {4, 5, 6, 8, 12, 40, 200, 1000}) {
    hold(many(count, [&] { return draw.cube(); }));
    hold(many(count, [&] { return draw.ball(); }));
    hold(many(count, [&] { return Vec3(draw.ball().normalized()); }));
  }
  WARN("convex hull: volume off by " << volume << " of the exact one");
  CHECK(volume < 1e-13);
}

// Oracle: the same. Rounding bends the faces of what is flat, so that CGAL may see more corners.
TEST_CASE("hulls that are thin or nearly flat have corners and volume of the exact one", "[long]") {
  PointDraw draw(2);
  for (const double thin : {1e-2, 1e-4, 1e-6, 3e-9})
    for (const Vec3& scale : {Vec3(1, 1, thin), Vec3(1, thin, thin)})
      for (int trial = 0; trial < 10; ++trial) {
        CAPTURE(scale, trial);
        const Points points = thinned(draw, trial % 2 ? 8 : 100, scale);
        const Points placed = trial % 4 < 2 ? points : turned(points, Vec3::Zero());
        CHECK(compare(placed).volume * thin * thin < 1e-11);
      }
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    CHECK(compare(nearGrid(draw, 2 + trial % 3)).volume < 1e-11);
  }
}
