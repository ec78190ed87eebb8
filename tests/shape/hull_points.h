// Points to take the convex hull of, and what any hull of them has to be.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "sim/body/mass_surface.h"
#include "sim/shape/convex_hull.h"
#include "tests/catch.h"

namespace tumble::test {

using Points = std::vector<Vec3>;

inline double sizeOf(const Points& given) {
  double size = 0.0;
  for (const Vec3& p : given) size = std::max(size, (p - given[0]).norm());
  return size;
}

/// How far [m] a point is beyond a face; in long doubles, as a thin face has no better normal.
inline double beyond(const Polyhedron& hull, const std::vector<int>& face, const Vec3& p) {
  using Long3 = Eigen::Matrix<long double, 3, 1>;
  const auto at = [&](std::size_t k) {
    return Long3(hull.points[static_cast<std::size_t>(face[k])].cast<long double>());
  };
  Long3 n = Long3::Zero();
  for (std::size_t k = 1; k + 1 < face.size(); ++k) n += (at(k) - at(0)).cross(at(k + 1) - at(0));
  return static_cast<double>(n.normalized().dot(p.cast<long double>() - at(0)));
}

/// A hull and what is known of it without a reference.
struct ClosedHull {
  Polyhedron hull;
  double outside = 0.0;  ///< farthest a point given is beyond a face, in units of the size
};

/// Takes the hull and checks that it is closed by Euler's formula and that its corners are points
/// given.
inline ClosedHull closedHull(const Points& given) {
  ClosedHull closed{convexHull(given), -1.0};
  const Polyhedron& hull = closed.hull;
  std::size_t edges = 0;
  for (const std::vector<int>& face : hull.faces) {
    edges += face.size();
    for (const Vec3& p : given)
      closed.outside = std::max(closed.outside, beyond(hull, face, p - given[0]));
  }
  closed.outside /= sizeOf(given);
  CHECK(edges % 2 == 0);
  CHECK(hull.points.size() + hull.faces.size() == edges / 2 + 2);
  for (const Vec3& corner : hull.points)
    CHECK(std::any_of(given.begin(), given.end(),
                      [&](const Vec3& p) { return p - given[0] == corner; }));
  CHECK_NOTHROW(makePolyhedron(hull.points, hull.faces));
  return closed;
}

/// Points at random, the same at every call.
class PointDraw {
 public:
  explicit PointDraw(unsigned seed) : engine_(seed) {}
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

inline Points many(int count, const std::function<Vec3()>& draw) {
  Points points;
  for (int i = 0; i < count; ++i) points.push_back(draw());
  return points;
}

inline Points grid(int n) {
  Points points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) points.emplace_back(i, j, k);
  return points;
}

inline Points turned(Points points, const Vec3& way) {
  const Quat q(0.3, -0.5, 0.7, 0.41);
  for (Vec3& p : points) p = q.normalized() * p + way;
  return points;
}

/// What rounding leaves of a grid: points within a unit in the last place of a few planes and
/// lines.
inline Points nearGrid(PointDraw& draw, int n) {
  Points points = turned(grid(n), Vec3(0.1, 0.2, 0.3));
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < 2 * count; ++i) {
    Vec3 p = points[i % count];
    p[static_cast<int>(i % 3)] = std::nextafter(p[static_cast<int>(i % 3)], 9.0 * draw.unit());
    points.push_back(p);
  }
  return points;
}

/// Points of a box of that size, its four corners of a tetrahedron among them.
inline Points thinned(PointDraw& draw, int count, const Vec3& scale) {
  Points points = many(count, [&] { return draw.cube(); });
  for (const Vec3& corner : {Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(-1, -1, 1), Vec3(1, -1, -1)})
    points.push_back(corner);
  for (Vec3& p : points) p = p.cwiseProduct(scale);
  return points;
}

}  // namespace tumble::test
