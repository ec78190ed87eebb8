#include "sim/shape/notches.h"

#include <algorithm>
#include <cmath>

#include "sim/math/orientation.h"

namespace tumble::cut {
namespace {

constexpr double kBent = 1e-9;  // sine: two faces that lean less to each other make no notch

/// Directed edges of a surface, each with the triangle on its left.
std::map<std::pair<int, int>, int> edgesOf(const Surface& surface) {
  std::map<std::pair<int, int>, int> left;
  for (std::size_t t = 0; t < surface.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      left[{surface[t].corner[k], surface[t].corner[(k + 1) % 3]}] = static_cast<int>(t);
  return left;
}

}  // namespace

// Decided exactly.
Notches::Notches(const Points& points, const Surface& whole, const std::vector<int>& flat,
                 OnPlane on)
    : points_(points), whole_(whole), on_(on) {
  const auto left = edgesOf(whole);
  for (const auto& [edge, f] : left) {
    const auto other = left.find({edge.second, edge.first});
    if (other == left.end() || edge.first > edge.second) continue;
    const int g = other->second;
    joined_.insert(std::minmax(f, g));
    if (flat[static_cast<std::size_t>(f)] == flat[static_cast<std::size_t>(g)]) continue;
    const auto [a, b] = edge;
    const auto apex = [&, a = a, b = b](int t) {
      for (const int p : whole_[static_cast<std::size_t>(t)].corner)
        if (p != a && p != b) return p;
      return a;
    };
    if (orientation(at(a), at(b), at(apex(f)), at(apex(g))) > 0) reflex_[std::minmax(f, g)] = edge;
  }
}

std::vector<Notch> Notches::of(const Surface& piece) const {
  const auto left = edgesOf(piece);
  std::vector<Notch> notches;
  for (const auto& [edge, t] : left) {
    const auto other = left.find({edge.second, edge.first});
    if (edge.first > edge.second || other == left.end()) continue;
    const int f = piece[static_cast<std::size_t>(t)].face;
    const int g = piece[static_cast<std::size_t>(other->second)].face;
    if (f >= 0 && g >= 0 && f != g && isNotch(f, g, edge.first, edge.second))
      notches.push_back({edge.first, edge.second, f, g});
  }
  return notches;
}

bool Notches::isNotch(int f, int g, int a, int b) const {
  if (reflex_.count(std::minmax(f, g)) > 0) return true;
  if (joined_.count(std::minmax(f, g)) > 0) return false;
  // A sliver between them is gone with corners that are on a cut: g runs on the right of the edge.
  const CutPlane left = planeOf(f), right = planeOf(g);
  return left.n.cross(right.n).dot(at(b) - at(a)) < -kBent * (at(b) - at(a)).norm();
}

Notches::Edge Notches::edgeOf(const Notch& notch) const {
  const auto known = reflex_.find(std::minmax(notch.left, notch.right));
  return known == reflex_.end() ? Edge(notch.from, notch.to) : known->second;
}

CutPlane Notches::planeOf(int triangle) const {
  const auto& corner = whole_[static_cast<std::size_t>(triangle)].corner;
  return planeThrough(at(corner[0]), at(corner[1]), at(corner[2]));
}

std::vector<CutPlane> Notches::planesAt(const Notch& notch,
                                        const std::vector<Notch>& others) const {
  const auto [a, b] = edgeOf(notch);
  const CutPlane left = planeOf(notch.left), right = planeOf(notch.right);
  std::vector<CutPlane> planes = {left, right};
  const double length = (at(b) - at(a)).norm();
  constexpr double kFolded = 1e-6;  // of two unit normals: less is back to back
  // Between the faces: into the solid, away from both.
  if (const Vec3 in = left.n + right.n; in.norm() > kFolded)
    planes.push_back(planeThrough(at(a), at(b), at(a) - length * in.normalized()));
  for (const Notch& other : others) {
    const auto [c, d] = edgeOf(other);
    if ((a == c) + (a == d) + (b == c) + (b == d) != 1) continue;
    const int third = a == c || b == c ? d : c;
    const CutPlane plane = planeThrough(at(a), at(b), at(third));
    if (!plane.n.allFinite()) continue;
    planes.push_back(on_.snap == 0.0 ? plane : spread(plane, others));
  }
  std::erase_if(planes, [](const CutPlane& plane) { return !plane.n.allFinite(); });
  return planes;
}

/// The plane through the notches near a plane that three of their corners far apart tell best.
CutPlane Notches::spread(CutPlane plane, const std::vector<Notch>& notches) const {
  constexpr double kBand = 32.0;  // of what a cut takes for on it
  for (int round = 0; round < 2; ++round) {
    std::vector<Vec3> near;
    for (const Notch& notch : notches)
      for (const int p : {notch.from, notch.to})
        if (std::abs(plane.height(at(p))) < kBand * on_.snap) near.push_back(at(p));
    if (near.size() < 3) return plane;
    const auto farthestBy = [&](auto measure) {
      return *std::max_element(near.begin(), near.end(), [&](const Vec3& p, const Vec3& q) {
        return measure(p) < measure(q);
      });
    };
    const Vec3 a = farthestBy([&](const Vec3& p) { return (p - near[0]).squaredNorm(); });
    const Vec3 b = farthestBy([&](const Vec3& p) { return (p - a).squaredNorm(); });
    const Vec3 c = farthestBy([&](const Vec3& p) { return (p - a).cross(b - a).squaredNorm(); });
    CutPlane better = planeThrough(a, b, c);
    if (!better.n.allFinite()) return plane;
    if (better.n.dot(plane.n) < 0.0) better = planeThrough(a, c, b);
    plane = better;
  }
  return plane;
}

bool Notches::resolves(const CutPlane& plane, const Notch& notch) const {
  if (std::abs(plane.height(at(notch.from))) > on_.slack ||
      std::abs(plane.height(at(notch.to))) > on_.slack)
    return false;
  const CutPlane left = planeOf(notch.left), right = planeOf(notch.right);
  const Vec3 e = (at(notch.to) - at(notch.from)).normalized();
  // The way that the plane takes into the solid turns from neither face by more than half a turn.
  const Vec3 way = plane.n.cross(e);
  const double l = left.n.dot(way), r = right.n.dot(way);
  return (l <= kRounding && r <= kRounding) || (l >= -kRounding && r >= -kRounding);
}

}  // namespace tumble::cut
