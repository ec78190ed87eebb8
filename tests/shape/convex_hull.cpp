// Chapter 2, shape: the convex hull of points, against the hull that CGAL finds exactly.
#include "sim/shape/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "sim/body/mass_surface.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Points = std::vector<Vec3>;
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

double sizeOf(const Points& given) {
  double size = 0.0;
  for (const Vec3& p : given) size = std::max(size, (p - given[0]).norm());
  return size;
}

/// How far [m] a point is beyond a face; in long doubles, as a thin face has no better normal.
double beyond(const Polyhedron& hull, const std::vector<int>& face, const Vec3& p) {
  using Long3 = Eigen::Matrix<long double, 3, 1>;
  const auto at = [&](std::size_t k) {
    return Long3(hull.points[static_cast<std::size_t>(face[k])].cast<long double>());
  };
  Long3 n = Long3::Zero();
  for (std::size_t k = 1; k + 1 < face.size(); ++k) n += (at(k) - at(0)).cross(at(k + 1) - at(0));
  return static_cast<double>(n.normalized().dot(p.cast<long double>() - at(0)));
}

struct Outcome {
  std::size_t corners, faces;
  double outside;  ///< farthest a point given is beyond a face, in units of the size
  double volume;   ///< off the reference, relative
};

/// Closed by Euler's formula, each corner one that CGAL has, all points inside.
Outcome check(const Points& given) {
  const Polyhedron hull = convexHull(given);
  const Reference exact = exactHull(given);
  std::size_t edges = 0;
  Outcome outcome{hull.points.size(), hull.faces.size(), -1.0, 0.0};
  for (const std::vector<int>& face : hull.faces) {
    edges += face.size();
    for (const Vec3& p : given)
      outcome.outside = std::max(outcome.outside, beyond(hull, face, p - given[0]));
  }
  outcome.outside /= sizeOf(given);
  CHECK(edges % 2 == 0);
  CHECK(hull.points.size() + hull.faces.size() == edges / 2 + 2);
  for (const Vec3& p : hull.points) CHECK(exact.corners.count(placeOf(p)) == 1);
  outcome.volume = std::abs(integrate(hull).volume / exact.volume - 1.0);
  CHECK_NOTHROW(makePolyhedron(hull.points, hull.faces));
  return outcome;
}

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double unit() { return std::ldexp(static_cast<double>(engine_() >> 11), -52) - 1.0; }
  Vec3 cube() { return {unit(), unit(), unit()}; }
  Vec3 ball() {
    Vec3 p = cube();
    while (p.squaredNorm() > 1.0) p = cube();
    return p;
  }

 private:
  std::mt19937_64 engine_;
};

Points many(int count, const std::function<Vec3()>& draw) {
  Points points;
  for (int i = 0; i < count; ++i) points.push_back(draw());
  return points;
}

Points grid(int n) {
  Points points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) points.emplace_back(i, j, k);
  return points;
}

Points turned(Points points, const Vec3& way) {
  const Quat q(0.3, -0.5, 0.7, 0.41);
  for (Vec3& p : points) p = q.normalized() * p + way;
  return points;
}

std::string refusal(const Points& points) {
  try {
    convexHull(points);
  } catch (const NotASolid& reason) {
    return reason.what();
  }
  return "";
}

}  // namespace

// Oracle: CGAL::convex_hull_3, exact. No two faces of points at random are in one plane, so the
// corners must be the same; volumes differ by the order of their sums, measured 2e-15.
TEST_CASE("the hull of points in a cube, in a ball and on a sphere has the exact corners",
          "[figures]") {
  Draw draw(1);
  double outside = 0.0, volume = 0.0;
  const auto hold = [&](const Points& points) {
    const Outcome outcome = check(points);
    CHECK(outcome.corners == exactHull(points).corners.size());
    CHECK(outcome.faces == 2 * outcome.corners - 4);
    outside = std::max(outside, outcome.outside);
    volume = std::max(volume, outcome.volume);
  };
  for (const int count : {4, 5, 6, 8, 12, 40, 200, 1000}) {
    hold(many(count, [&] { return draw.cube(); }));
    hold(many(count, [&] { return draw.ball(); }));
    hold(many(count, [&] { return Vec3(draw.ball().normalized()); }));
  }
  WARN("convex hull: a point outside by measured " << outside << " of the size, volume off by "
                                                   << volume);
  CHECK(outside < 1e-15);
  CHECK(volume < 1e-13);
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
        const Outcome outcome = check(points);
        CHECK(outcome.corners == 8);
        CHECK(outcome.faces == 6);
        CHECK(outcome.outside <= allowed);
        CHECK(outcome.volume <= 10.0 * allowed);
      }
    }
}

TEST_CASE("the faces of a prism with many sides are polygons") {
  Points points;
  for (int i = 0; i < 24; ++i)
    for (const double y : {-1.0, 0.0, 1.0})
      points.emplace_back(std::cos(EIGEN_PI * i / 12), y, std::sin(EIGEN_PI * i / 12));
  const Outcome outcome = check(turned(points, Vec3(1, 2, 3)));
  CHECK(outcome.corners == 48);
  CHECK(outcome.faces == 26);
  CHECK(outcome.outside < 1e-15);
}

// Down to what is refused. The normal of a face 3e-9 wide errs by 3e-11 even in long doubles;
// measured 1.1e-11.
TEST_CASE("nearly flat and thin hulls are closed and hold their points", "[figures]") {
  Draw draw(2);
  double outside = 0.0, volume = 0.0;
  for (const double thin : {1e-2, 1e-4, 1e-6, 3e-9})
    for (const Vec3& scale : {Vec3(1, 1, thin), Vec3(1, thin, thin)})
      for (int trial = 0; trial < 10; ++trial) {
        CAPTURE(scale, trial);
        const auto thinned = [&](Vec3 p) { return Vec3(p.cwiseProduct(scale)); };
        Points points = many(trial % 2 ? 8 : 100, [&] { return thinned(draw.cube()); });
        points.push_back(thinned(Vec3(1, 1, 1)));
        points.push_back(thinned(Vec3(-1, 1, -1)));
        points.push_back(thinned(Vec3(-1, -1, 1)));
        points.push_back(thinned(Vec3(1, -1, -1)));
        const Outcome outcome = check(trial % 4 < 2 ? points : turned(points, Vec3::Zero()));
        outside = std::max(outside, outcome.outside);
        volume = std::max(volume, outcome.volume * thin * thin);
      }
  WARN("thin hulls: a point outside by measured " << outside << " of the size");
  CHECK(outside < 5e-11);
  CHECK(volume < 1e-11);
}

// What rounding leaves of points in a few planes and on a few lines: the hardest for a hull.
TEST_CASE("points within a unit in the last place of the faces of a cube have a closed hull") {
  Draw draw(3);
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    Points points = turned(grid(2 + trial % 3), Vec3(0.1, 0.2, 0.3));
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < 2 * count; ++i) {
      Vec3 p = points[i % count];
      p[static_cast<int>(i % 3)] = std::nextafter(p[static_cast<int>(i % 3)], 9.0 * draw.unit());
      points.push_back(p);
    }
    const Outcome outcome = check(points);
    CHECK(outcome.outside < 1e-12);
    CHECK(outcome.faces <= 26);
  }
}

TEST_CASE("copies and the order of the points leave a hull as it is") {
  Draw draw(4);
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
    CAPTURE(refusal(points));
    return refusal(points).find(part) != std::string::npos;
  };
  const Vec3 o = Vec3::Zero(), x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  CHECK(says({o, x, y}, "four points or more, found 3"));
  CHECK(says({o, o, o, o, o}, "one place"));
  CHECK(says({o, x, 2 * x, 3 * x, o}, "on a line"));
  CHECK(says({o, x, y, x + y, 0.5 * x}, "in a plane"));
  CHECK(says({o, x, y, x + y + 0.9e-9 * z}, "in a plane"));
  CHECK(says({o, x, y, x + y + Vec3(0, 0, std::nan(""))}, "point 4 is not finite"));
  CHECK(refusal({o, x, y, x + y + 1e-8 * z}).empty());
  CHECK(refusal({o, x, y, z}).empty());
  const Vec3 far(1e6, 1e6, 1e6);
  CHECK(refusal({far, far + x, far + y, far + z, far}).empty());
  CHECK(says({-1e308 * x, 1e308 * x, y, z}, "too far apart"));
  CHECK(refusal({1e-200 * x, o, 1e-200 * y, 1e-200 * z, 1e-320 * z}).empty());
  CHECK(refusal({1e200 * x, o, 1e200 * y, 1e200 * z, 1e-320 * z}).empty());
}
