#include "sim/shape/crossings.h"

#include <algorithm>
#include <cmath>

#include "sim/math/orientation.h"
#include "sim/shape/box_tree.h"

namespace tumble {
namespace {

using Corners = std::array<int, 3>;

const Vec3& at(const Polyhedron& solid, int p) {
  return solid.points[static_cast<std::size_t>(p)];
}

// Surfaces that overlap by less than this part of the solid's size touch.
constexpr double kTouch = 1e-9;

/// How far [m] an edge that passes through a triangle would have to move not to.
double passesBy(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a).normalized();
  const double above = n.dot(from - a), below = n.dot(to - a);
  double least = std::min(std::abs(above), std::abs(below));
  const Vec3 x = from + above / (above - below) * (to - from);
  for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
    least = std::min(least, n.cross(q - p).normalized().dot(x - p));
  return least;
}

/// Whether the edge from p to q passes through the inside of a triangle.
bool passesThrough(const Polyhedron& solid, int p, int q, const Corners& t, double touch) {
  if (std::count(t.begin(), t.end(), p) + std::count(t.begin(), t.end(), q) > 0) return false;
  const Vec3 &a = at(solid, t[0]), &b = at(solid, t[1]), &c = at(solid, t[2]);
  const Vec3 &from = at(solid, p), &to = at(solid, q);
  return pierces(from, to, a, b, c) && passesBy(from, to, a, b, c) > touch;
}

bool cross(const Polyhedron& solid, const Corners& s, const Corners& t, double touch) {
  for (std::size_t k = 0; k < 3; ++k)
    if (passesThrough(solid, s[k], s[(k + 1) % 3], t, touch) ||
        passesThrough(solid, t[k], t[(k + 1) % 3], s, touch))
      return true;
  return false;
}

/// Whether the edges of a face from its corners i and k cross, seen along an axis: exactly, and by
/// more than touching.
bool outlineCrosses(const std::vector<Vec3>& seen, std::size_t i, std::size_t k, int axis,
                    double touch) {
  const std::size_t count = seen.size();
  const Vec3 &a = seen[i], &b = seen[(i + 1) % count], &c = seen[k], &d = seen[(k + 1) % count];
  if (!Aabb{a.cwiseMin(b), a.cwiseMax(b)}.overlaps({c.cwiseMin(d), c.cwiseMax(d)})) return false;
  const Vec3 up = Vec3::Unit(axis);
  const auto parts = [&](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
    const Vec3 across = up.cross(q - p).normalized();
    return orientation(p, q, p + up, r) * orientation(p, q, p + up, s) < 0 &&
           std::min(std::abs(across.dot(r - p)), std::abs(across.dot(s - p))) > touch;
  };
  return parts(a, b, c, d) && parts(c, d, a, b);
}

/// The outline of a face bounds one area, on its left, seen along the axis that is nearest to its
/// normal.
void checkOutline(const Polyhedron& solid, std::size_t f, double touch) {
  const std::vector<int>& face = solid.faces[f];
  int axis = 0;
  areaVector(solid, face).cwiseAbs().maxCoeff(&axis);
  std::vector<Vec3> seen;
  for (const int i : face) seen.push_back(at(solid, i)), seen.back()[axis] = 0.0;
  const auto edge = [&](std::size_t k) {
    return std::to_string(face[k] + 1) + " to " + std::to_string(face[(k + 1) % face.size()] + 1);
  };
  for (std::size_t i = 0; i < face.size(); ++i)
    for (std::size_t k = i + 2; k < face.size(); ++k)
      if (outlineCrosses(seen, i, k, axis, touch))
        throw NotASolid("the outline of face " + std::to_string(f + 1) +
                            " crosses itself, where the edge from point " + edge(i) +
                            " passes that from point " + edge(k),
                        static_cast<int>(f));
}

}  // namespace

void checkCrossings(const Polyhedron& solid, double least) {
  std::vector<Corners> triangles;
  std::vector<int> face;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    cutIntoTriangles(solid, solid.faces[f], triangles);
    face.resize(triangles.size(), static_cast<int>(f));
  }
  std::vector<Aabb> boxes;
  for (const auto& [a, b, c] : triangles)
    boxes.push_back({at(solid, a).cwiseMin(at(solid, b)).cwiseMin(at(solid, c)),
                     at(solid, a).cwiseMax(at(solid, b)).cwiseMax(at(solid, c))});
  const BoxTree tree(boxes);
  const double touch =
      std::max(least, kTouch * (tree.nodes()[0].box.hi - tree.nodes()[0].box.lo).norm());
  std::pair<int, int> first{-1, -1};
  for (std::size_t f = 0; f < solid.faces.size(); ++f) checkOutline(solid, f, touch);
  const double reach = 0.0;
  forNear(tree, tree, Seat{}, reach, [&](int i, int j) {
    const std::pair faces(face[static_cast<std::size_t>(i)], face[static_cast<std::size_t>(j)]);
    if (faces.first >= faces.second || (first.first >= 0 && first <= faces)) return;
    if (cross(solid, triangles[static_cast<std::size_t>(i)], triangles[static_cast<std::size_t>(j)],
              touch))
      first = faces;
  });
  if (first.first >= 0)
    throw NotASolid("face " + std::to_string(first.first + 1) + " and face " +
                        std::to_string(first.second + 1) + " pass through each other",
                    first.first);
}

}  // namespace tumble
