// Convex hulls for the tests of collide.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "sim/math/rotation.h"
#include "sim/shape/convex_hull.h"
#include "sim/shape/shape.h"
#include "tests/collide/random_pose.h"

namespace tumble {

/// The hull of points, with the body origin at the points' own.
inline Hull hullOf(const std::vector<Vec3>& points) {
  return {std::make_shared<const Polyhedron>(convexHull(points)), -points[0]};
}

/// Some of `count` points near a sphere.
inline Hull someHull(Random& random, int count, double size = 0.7) {
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    const Vec3 n = random.direction();
    points.push_back(random.uniform(0.7, 1.0) * size * n);
  }
  return hullOf(points);
}

/// A box as a hull.
inline Hull boxHull(const Vec3& half) {
  std::vector<Vec3> points;
  for (int v = 0; v < 8; ++v)
    points.push_back(
        half.cwiseProduct(Vec3(v & 1 ? 1.0 : -1.0, v & 2 ? 1.0 : -1.0, v & 4 ? 1.0 : -1.0)));
  return {
      std::make_shared<const Polyhedron>(makePolyhedron(
          points,
          {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}})),
      half};
}

/// A prism about Y with corners at a distance r.
inline Hull prismHull(int corners, double r, double h) {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces(2);
  for (int k = 0; k < corners; ++k) {
    double s = 0.0, c = 0.0;
    sinCos(6.283185307179586 * k / corners, s, c);
    points.push_back({r * c, -0.5 * h, r * s});
    points.push_back({r * c, 0.5 * h, r * s});
  }
  const int all = 2 * corners;
  for (int k = 0; k < corners; ++k) {
    faces[0].push_back(2 * k);
    faces[1].push_back((all - 2 * k + 1) % all);
    faces.push_back({2 * k, 2 * k + 1, (2 * k + 3) % all, (2 * k + 2) % all});
  }
  const Vec3 first = points[0];
  return {std::make_shared<const Polyhedron>(makePolyhedron(points, faces)), -first};
}

}  // namespace tumble
