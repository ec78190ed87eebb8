#include "sim/collide/polygon_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/math/frames.h"

namespace tumble {
namespace {

using Corners = PolygonSoup::Corners;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kAxes = 17;            // two faces, nine pairs of edges, three sides each
constexpr double kRounding = 8e-15;  // of size and distance, as of `certifiedSeparation`
// Below this sine two directions are one up to rounding.
constexpr double kParallel = 1e-12;

Vec3 edge(const Corners& t, int k) {
  return t.at[(k + 1) % 3] - t.at[k];
}

Vec3 normal(const Corners& t) {
  return edge(t, 0).cross(edge(t, 1));
}

// A direction that may part two triangles; of any length, 0 if it is none there.
Vec3 directionOf(int axis, const Corners& a, const Corners& b) {
  if (axis == 0) return normal(b);
  if (axis == 1) return normal(a);
  if (axis < 11) {
    const Vec3 p = edge(a, (axis - 2) / 3), q = edge(b, (axis - 2) % 3), n = p.cross(q);
    return n.norm() > kParallel * p.norm() * q.norm() ? n : Vec3(Vec3::Zero());
  }
  return axis < 14 ? edge(a, axis - 11).cross(normal(a)) : edge(b, axis - 14).cross(normal(b));
}

// The lowest corner of each set of triangles that hang together.
std::vector<int> firstOfShells(std::size_t count,
                               const std::vector<std::array<int, 3>>& triangles) {
  std::vector<int> up(count);
  std::iota(up.begin(), up.end(), 0);
  const auto root = [&](int i) {
    while (up[static_cast<std::size_t>(i)] != i) i = up[static_cast<std::size_t>(i)];
    return i;
  };
  for (const auto& corner : triangles)
    for (const int p : corner) {
      const int i = root(corner[0]), j = root(p);
      up[static_cast<std::size_t>(std::max(i, j))] = std::min(i, j);
      up[static_cast<std::size_t>(p)] = std::min(i, j);
    }
  std::vector<int> first;
  for (const auto& corner : triangles)
    for (const int p : corner) first.push_back(root(p));
  std::sort(first.begin(), first.end());
  first.erase(std::unique(first.begin(), first.end()), first.end());
  return first;
}

double rounding(double size, double distance) {
  return kRounding * (size + distance);
}

}  // namespace

double gapAlong(int axis, const Corners& a, const Corners& b) {
  const Vec3 way = directionOf(axis, a, b);
  const double length = way.norm();
  if (!(length > 0.0)) return -kInfinity;
  // About a corner of b, so that nothing is lost far from the origin.
  const Vec3 n = way / length;
  double lowA = kInfinity, topA = -kInfinity, lowB = kInfinity, topB = -kInfinity;
  for (int k = 0; k < 3; ++k) {
    const double p = n.dot(a.at[k] - b.at[0]), q = n.dot(b.at[k] - b.at[0]);
    lowA = std::min(lowA, p), topA = std::max(topA, p);
    lowB = std::min(lowB, q), topB = std::max(topB, q);
  }
  return std::max(lowA - topB, lowB - topA);
}

TrianglePlane widestBetween(const Corners& a, const Corners& b) {
  TrianglePlane widest{-1, -kInfinity};
  for (int axis = 0; axis < kAxes; ++axis) {
    const double gap = gapAlong(axis, a, b);
    if (gap > widest.gap) widest = {axis, gap};
  }
  return widest;
}

PolygonSoup::PolygonSoup(const Mesh& mesh) : shape_(mesh), inside_(shape_), origin_(mesh.origin) {
  const Polyhedron& solid = *mesh.solid;
  std::vector<std::array<int, 3>> cut;
  for (const std::vector<int>& face : solid.faces) cutIntoTriangles(solid, face, cut);
  for (const int p : firstOfShells(solid.points.size(), cut))
    shells_.push_back(solid.points[static_cast<std::size_t>(p)] - origin_);
  std::vector<Aabb> boxes;
  for (const auto& corner : cut) {
    Corners& t = triangles_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      t.at[k] = solid.points[static_cast<std::size_t>(corner[k])] - origin_;
      size_ = std::max(size_, t.at[k].norm());
    }
    boxes.push_back(
        {t.at[0].cwiseMin(t.at[1]).cwiseMin(t.at[2]), t.at[0].cwiseMax(t.at[1]).cwiseMax(t.at[2])});
  }
  tree_ = BoxTree(boxes);
}

PolygonLook PolygonPairs::look(const Pose& poseA, const Pose& poseB) {
  // In the frame of b, where its corners are what they are.
  const Seat aInB = seatOf(poseB, poseA), bInA = seatOf(poseA, poseB);
  PolygonLook look;
  look.least = kInfinity;
  look.bound = rounding(a_.size() + b_.size(), aInB.x.norm());
  std::map<std::pair<int, int>, int> planes;
  const double reach = look.bound;
  forNear(
      a_.tree(), b_.tree(), bInA, reach,
      [&](int i, int j) {
        ++look.pairs;
        Corners t = a_.triangles()[static_cast<std::size_t>(i)];
        for (Vec3& p : t.at) p = aInB.R * p + aInB.x;
        const Corners& u = b_.triangles()[static_cast<std::size_t>(j)];
        const auto known = planes_.find({i, j});
        if (known != planes_.end()) {
          const double gap = gapAlong(known->second, t, u);
          if (gap > look.bound) {
            ++look.remembered;
            look.least = std::min(look.least, gap);
            planes.emplace(*known);
            return;
          }
        }
        const TrianglePlane plane = widestBetween(t, u);
        look.least = std::min(look.least, plane.gap);
        if (plane.gap > 0.0)
          planes.emplace(std::pair(i, j), plane.axis);
        else
          ++look.touching;
      },
      &look.boxes);
  planes_ = std::move(planes);
  look.apart = look.touching == 0;
  if (!look.apart) return look;
  // Surfaces apart: one solid may still be inside the other.
  for (const Vec3& p : a_.shells()) look.apart = look.apart && !b_.contains(aInB.R * p + aInB.x);
  for (const Vec3& p : b_.shells()) look.apart = look.apart && !a_.contains(bInA.R * p + bInA.x);
  return look;
}

}  // namespace tumble
