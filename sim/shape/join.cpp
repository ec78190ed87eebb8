#include "sim/shape/join.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "sim/shape/convex_hull.h"
#include "sim/shape/plane_tree.h"

namespace tumble {
namespace {

Aabb boxOf(const Polyhedron& solid, double slack) {
  Aabb box{solid.points[0], solid.points[0]};
  for (const Vec3& p : solid.points) box = {box.lo.cwiseMin(p), box.hi.cwiseMax(p)};
  const Vec3 more = Vec3::Constant(slack);
  return {box.lo - more, box.hi + more};
}

/// A convex solid, and how far [m] it reaches out of what it was joined from.
struct Joined {
  Polyhedron solid;
  double reach = 0.0;
  int number = 0;  ///< a new one for each that is joined
};

/// The planes of those faces of a solid that another one does not lie beyond.
void addFacesBeside(const Polyhedron& solid, const Polyhedron& other, double slack,
                    std::vector<HalfSpace>& planes) {
  for (const HalfSpace& plane : facesOf(solid))
    if (std::any_of(other.points.begin(), other.points.end(),
                    [&](const Vec3& p) { return plane.n.dot(p) < plane.d - slack; }))
      planes.push_back(plane);
}

/// The convex union of two solids, if it is one; none if both are flatter than numbers can tell.
bool join(Joined& a, const Joined& b, const Joining& joint) {
  std::vector<Vec3> corners = a.solid.points;
  corners.insert(corners.end(), b.solid.points.begin(), b.solid.points.end());
  Polyhedron both;
  try {
    both = hullInFrame(corners);
  } catch (const NotASolid&) {
    return false;
  }
  const double more = std::abs(volumeOf(both) - volumeOf(a.solid) - volumeOf(b.solid));
  if (more > joint.thin * areaOf(both)) return false;
  // What is in front of no face of either but those between them is in one of them.
  std::vector<HalfSpace> planes;
  addFacesBeside(a.solid, b.solid, joint.slack, planes);
  addFacesBeside(b.solid, a.solid, joint.slack, planes);
  const double reach = std::max(a.reach, b.reach) + reachOver(both, std::move(planes));
  if (reach > joint.reach) return false;
  a.solid = std::move(both);
  a.reach = reach;
  return true;
}

/// Numbers of two solids that make no convex one.
using Apart = std::set<std::pair<int, int>>;

/// Joins the first two that make a convex one.
bool joinOne(std::vector<Joined>& list, const Joining& joint, int& next, Apart& apart) {
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t j = i + 1; j < list.size(); ++j) {
      if (apart.count({list[i].number, list[j].number}) > 0) continue;
      if (!boxOf(list[i].solid, joint.slack).overlaps(boxOf(list[j].solid, joint.slack)) ||
          !join(list[i], list[j], joint)) {
        apart.emplace(list[i].number, list[j].number);
        continue;
      }
      list[i].number = next++;
      list.erase(list.begin() + static_cast<std::ptrdiff_t>(j));
      return true;
    }
  return false;
}

}  // namespace

std::vector<HalfSpace> facesOf(const Polyhedron& solid) {
  std::vector<HalfSpace> planes;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Vec3& foot = solid.points[static_cast<std::size_t>(solid.faces[f][0])];
    planes.push_back({solid.normals[f], solid.normals[f].dot(foot)});
  }
  return planes;
}

double sizeOf(const Polyhedron& solid) {
  double size = 0.0;
  for (const Vec3& p : solid.points) size = std::max(size, (p - solid.points[0]).norm());
  return size;
}

double volumeOf(const Polyhedron& solid) {
  double sum = 0.0;
  for (const std::vector<int>& face : solid.faces)
    sum += (solid.points[static_cast<std::size_t>(face[0])] - solid.points[0])
               .dot(areaVector(solid, face));
  return sum / 6.0;
}

double areaOf(const Polyhedron& solid) {
  double sum = 0.0;
  for (const std::vector<int>& face : solid.faces) sum += 0.5 * areaVector(solid, face).norm();
  return sum;
}

namespace {

/// How far a corner is from the solid below all planes of a tree, at most; `middle` is in it. Only
/// planes that are near it can be passed on the way.
double wayInto(const PlaneTree& tree, const Vec3& corner, const Vec3& middle) {
  constexpr double kWide = 1.5;     // of the height over planes: the way is seldom longer
  constexpr double kGrain = 1e-12;  // of the way to the middle: what rounding may come to
  constexpr int kRounds = 16;
  const auto height = [&](int i, const Vec3& p) {
    const HalfSpace& plane = tree.planes()[static_cast<std::size_t>(i)];
    return plane.n.dot(p) - plane.d;
  };
  std::vector<int> near;
  tree.above(corner, 0.0, near);
  if (near.empty()) return 0.0;
  double around = kGrain * (middle - corner).norm();
  for (const int i : near) around = std::max(around, kWide * height(i, corner));
  for (;; around *= kWide) {
    tree.above(corner, -around, near);
    // Into K by one plane after the other, then towards the middle for what is left.
    Vec3 p = corner;
    double away = 0.0;
    bool inside = false;
    for (int round = 0; round < kRounds && !inside; ++round) {
      inside = true;
      for (const int i : near)
        if (const double h = height(i, p); h > 0.0) {
          p -= h * tree.planes()[static_cast<std::size_t>(i)].n, inside = false;
          away = std::max(away, (p - corner).norm());
        }
    }
    if (away > (1.0 - kGrain) * around) continue;
    double share = 0.0;
    for (const int i : near)
      if (const double h = height(i, p); h > 0.0)
        share = std::max(share, h / (h - height(i, middle)));
    return (p + share * (middle - p) - corner).norm();
  }
}

}  // namespace

double reachOver(const Polyhedron& convex, std::vector<HalfSpace> planes, long* looks) {
  for (const HalfSpace& face : facesOf(convex)) planes.push_back(face);
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : convex.points) middle += p / static_cast<double>(convex.points.size());
  if (looks) *looks += static_cast<long>(planes.size());
  for (const HalfSpace& plane : planes)
    if (!(plane.n.dot(middle) - plane.d < 0.0)) return std::numeric_limits<double>::infinity();
  const PlaneTree tree(std::move(planes));
  double reach = 0.0;
  for (const Vec3& corner : convex.points) reach = std::max(reach, wayInto(tree, corner, middle));
  if (looks) *looks += tree.looks();
  return reach;
}

double heightOver(const std::vector<HalfSpace>& planes, const std::vector<Vec3>& points) {
  double height = 0.0;
  for (const HalfSpace& plane : planes)
    for (const Vec3& p : points) height = std::max(height, plane.n.dot(p) - plane.d);
  return height;
}

std::optional<Polyhedron> below(const Polyhedron& convex, const std::vector<HalfSpace>& planes,
                                double on) {
  Polyhedron rest = convex;
  for (const HalfSpace& plane : planes) {
    if (heightOver({plane}, rest.points) <= on) continue;
    // The corners below, and where edges pass.
    std::vector<Vec3> corners;
    const auto height = [&](int i) {
      return plane.n.dot(rest.points[static_cast<std::size_t>(i)]) - plane.d;
    };
    for (int i = 0; i < static_cast<int>(rest.points.size()); ++i)
      if (height(i) <= on) corners.push_back(rest.points[static_cast<std::size_t>(i)]);
    for (const Polyhedron::Edge& edge : rest.edges) {
      const double from = height(edge.from), to = height(edge.to);
      if ((from > on && to < -on) || (from < -on && to > on)) {
        const Vec3 &p = rest.points[static_cast<std::size_t>(edge.from)],
                   &q = rest.points[static_cast<std::size_t>(edge.to)];
        corners.push_back(p + from / (from - to) * (q - p));
      }
    }
    try {
      rest = hullInFrame(corners);
    } catch (const NotASolid&) {
      return {};
    }
  }
  return rest;
}

double joinConvex(std::vector<Polyhedron>& solids, const Joining& joint) {
  std::vector<Joined> list;
  int next = 0;
  for (Polyhedron& solid : solids)
    if (!solid.points.empty()) list.push_back({std::move(solid), 0.0, next++});
  Apart apart;
  while (joinOne(list, joint, next, apart)) {
  }
  solids.clear();
  double reach = 0.0;
  for (Joined& joined : list) {
    reach = std::max(reach, joined.reach);
    solids.push_back(std::move(joined.solid));
  }
  return reach;
}

}  // namespace tumble
