#include "sim/shape/excess.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "sim/shape/join.h"
#include "sim/shape/plane_tree.h"

namespace tumble {
namespace {

Vec3 nearestOnEdge(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 along = b - a;
  return a + std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0) * along;
}

Vec3 nearestOn(const std::array<Vec3, 3>& t, const Vec3& p) {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  bool over = true;
  for (std::size_t k = 0; k < 3; ++k)
    over = over && n.dot((t[(k + 1) % 3] - t[k]).cross(p - t[k])) >= 0.0;
  if (over) return p - n.dot(p - t[0]) / n.squaredNorm() * n;
  Vec3 best = nearestOnEdge(t[0], t[1], p);
  for (std::size_t k = 1; k < 3; ++k)
    if (const Vec3 q = nearestOnEdge(t[k], t[(k + 1) % 3], p);
        (q - p).squaredNorm() < (best - p).squaredNorm())
      best = q;
  return best;
}

double squaredDistance(const Aabb& box, const Vec3& p) {
  return (p - p.cwiseMax(box.lo).cwiseMin(box.hi)).squaredNorm();
}

/// A cube about a middle that may hold points of the solid.
struct Cell {
  double bound;  ///< [m] no point in it is further from the mesh
  Vec3 middle;
  double half;  ///< [m] of an edge
  double size;  ///< [m] of the distance at the middle
  bool met;     ///< whether it is known to meet the solid
  bool operator<(const Cell& other) const { return bound < other.bound; }
};

}  // namespace

MeshDistance::MeshDistance(const Polyhedron& solid)
    : mesh_(Mesh{std::make_shared<const Polyhedron>(solid)}), interior_(mesh_) {
  std::vector<std::array<int, 3>> corners;
  for (const std::vector<int>& face : solid.faces) cutIntoTriangles(solid, face, corners);
  std::vector<Aabb> boxes;
  for (const auto& [a, b, c] : corners) {
    const auto at = [&](int i) { return solid.points[static_cast<std::size_t>(i)]; };
    triangles_.push_back({at(a), at(b), at(c)});
    boxes.push_back({at(a).cwiseMin(at(b)).cwiseMin(at(c)), at(a).cwiseMax(at(b)).cwiseMax(at(c))});
  }
  tree_ = BoxTree(boxes);
}

void MeshDistance::descend(int node, const Vec3& p, Nearest& best) const {
  const BoxTree::Node& here = tree_.nodes()[static_cast<std::size_t>(node)];
  ++looks_;
  if (here.item >= 0) {
    const Vec3 q = nearestOn(triangles_[static_cast<std::size_t>(here.item)], p);
    if (const double squared = (q - p).squaredNorm(); squared < best.squared) best = {squared, q};
    return;
  }
  const auto far = [&](int child) {
    return squaredDistance(tree_.nodes()[static_cast<std::size_t>(child)].box, p);
  };
  int child[2] = {here.first, here.last};
  double squared[2] = {far(child[0]), far(child[1])};
  const int near = squared[1] < squared[0] ? 1 : 0;
  for (const int k : {near, 1 - near})
    if (squared[k] < best.squared) descend(child[k], p, best);
}

double MeshDistance::operator()(const Vec3& p, double reach) const {
  Nearest best{reach * reach};
  descend(0, p, best);
  const double size = std::sqrt(best.squared);
  return interior_.contains(p) ? -size : size;
}

Vec3 MeshDistance::nearest(const Vec3& p) const {
  Nearest best{std::numeric_limits<double>::infinity()};
  descend(0, p, best);
  return best.point;
}

Excess excessOf(const Polyhedron& convex, const MeshDistance& distance, double allowed, long most) {
  constexpr double kFinest = 1.0 / 16.0;  // of what is allowed: smaller cells are not halved
  Vec3 lo = convex.points[0], hi = lo;
  for (const Vec3& p : convex.points) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
  const PlaneTree faces(facesOf(convex));
  const long before = distance.looks();
  std::priority_queue<Cell> cells;
  Excess excess;
  double farthest = 0.0;
  const auto add = [&](const Vec3& middle, double half, double reach) {
    const double d = distance(middle, reach), way = std::sqrt(3.0) * half;
    const bool matters = d + way > allowed;
    if (matters && faces.isOver(middle, half)) return;
    if (d > farthest && !faces.isOver(middle, 0.0)) farthest = d, excess.where = middle;
    cells.push({d + way, middle, half, std::abs(d), matters});
  };
  const auto looks = [&] { return faces.looks() + distance.looks() - before; };
  add(0.5 * (lo + hi), 0.5 * (hi - lo).maxCoeff(), std::numeric_limits<double>::infinity());
  while (!cells.empty() && cells.top().bound > allowed && farthest <= allowed && looks() < most) {
    const Cell cell = cells.top();
    if (cell.half * std::sqrt(3.0) < kFinest * allowed) {
      if (farthest == 0.0) excess.where = cell.middle;
      break;
    }
    cells.pop();
    const double half = 0.5 * cell.half, reach = cell.size + std::sqrt(3.0) * half;
    for (int k = 0; k < 8; ++k)
      add(cell.middle + half * Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1), half,
          (1.0 + 1e-12) * reach);
  }
  // Of cells that did not matter those beside the solid are left out now, up to the bound.
  while (!cells.empty() && !cells.top().met && faces.isOver(cells.top().middle, cells.top().half))
    cells.pop();
  excess.bound = cells.empty() ? 0.0 : std::max(0.0, cells.top().bound);
  excess.looks = looks();
  return excess;
}

}  // namespace tumble
