// Polyhedra for tests, with whole-number points where they can have them.
#pragma once

#include <algorithm>
#include <cmath>

#include "sim/shape/shape.h"

namespace tumble::solids {

struct Raw {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  Polyhedron made() const { return makePolyhedron(points, faces); }
  Mesh mesh() const { return {std::make_shared<const Polyhedron>(made()), Vec3::Zero()}; }
};

/// Corner (0, 0, 0) at `lo`, edges along the axes.
inline Raw box(const Vec3& lo, const Vec3& hi) {
  Raw raw;
  for (int k = 0; k < 8; ++k)
    raw.points.emplace_back(k & 1 ? hi.x() : lo.x(), k & 2 ? hi.y() : lo.y(),
                            k & 4 ? hi.z() : lo.z());
  raw.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return raw;
}

inline Raw tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// A polygon in the xy plane, counter-clockwise, extruded from z = 0 to z = h; its two flat faces
/// are single polygons, convex or not.
inline Raw prism(const std::vector<Vec3>& polygon, double h) {
  Raw raw;
  const int n = static_cast<int>(polygon.size());
  std::vector<int> top, bottom;
  for (const Vec3& p : polygon) raw.points.push_back(p);
  for (const Vec3& p : polygon) raw.points.push_back(p + Vec3(0, 0, h));
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    raw.faces.push_back({i, j, j + n, i + n});
    top.push_back(i + n);
    bottom.push_back(n - 1 - i);
  }
  raw.faces.push_back(top);
  raw.faces.push_back(bottom);
  return raw;
}

/// Three unit cubes in an L (not convex).
inline Raw ell() {
  return prism({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, 1.0);
}

/// Two cubes of edge `cube` [m] with their centres at x = ±1, joined by a bar of width `bar`.
inline Raw dumbbell(double cube = 0.5, double bar = 0.1) {
  Raw raw;
  for (const double side : {-1.0, 1.0}) {
    const int first = static_cast<int>(raw.points.size());
    // Corners in the yz plane, counter-clockwise about +x: far face, near face, end of the bar.
    const Vec3 turns[4] = {{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}};
    const double at[3] = {1.0 + 0.5 * cube, 1.0 - 0.5 * cube, 1.0 - 0.5 * cube};
    const double wide[3] = {0.5 * cube, 0.5 * cube, 0.5 * bar};
    for (int ring = 0; ring < 3; ++ring)
      for (const Vec3& t : turns)
        raw.points.push_back(wide[ring] * t + Vec3(side * at[ring], 0, 0));
    const auto add = [&](std::vector<int> face) {
      for (int& i : face) i += first;
      raw.faces.push_back(side > 0.0 ? face : std::vector<int>(face.rbegin(), face.rend()));
    };
    add({0, 1, 2, 3});
    for (int k = 0; k < 4; ++k) {
      const int l = (k + 1) % 4;
      add({k, 4 + k, 4 + l, l});
      add({4 + k, 8 + k, 8 + l, 4 + l});
    }
  }
  for (int k = 0; k < 4; ++k) {
    const int l = (k + 1) % 4;
    raw.faces.push_back({8 + k, 8 + l, 20 + l, 20 + k});
  }
  return raw;
}

/// A ring about z: `around` times `across` four-cornered faces, none of them quite flat.
inline Raw torus(double R, double r, int around, int across) {
  constexpr double kTurn = 6.283185307179586;
  Raw raw;
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) {
      const double u = kTurn * i / around, v = kTurn * k / across;
      const double out = R + r * std::cos(v);
      raw.points.emplace_back(out * std::cos(u), out * std::sin(u), r * std::sin(v));
    }
  const auto at = [&](int i, int k) { return (i % around) * across + k % across; };
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k)
      raw.faces.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
  return raw;
}

/// The same surface seen from the other side: the wall of a cavity.
inline Raw reversed(Raw raw) {
  for (std::vector<int>& face : raw.faces) std::reverse(face.begin(), face.end());
  return raw;
}

/// Two surfaces as one.
inline Raw together(Raw a, const Raw& b) {
  const int first = static_cast<int>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (std::vector<int> face : b.faces) {
    for (int& p : face) p += first;
    a.faces.push_back(std::move(face));
  }
  return a;
}

/// The same with every point moved, and rounded there.
inline Raw moved(Raw raw, const Vec3& way) {
  for (Vec3& p : raw.points) p += way;
  return raw;
}

inline Raw turned(Raw raw, const Quat& q) {
  for (Vec3& p : raw.points) p = q * p;
  return raw;
}

}  // namespace tumble::solids
