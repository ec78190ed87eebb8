#include "sim/audit/cloth_crossings.h"

#include <algorithm>

#include "sim/math/orientation.h"

namespace tumble {
namespace {

bool meet(const Aabb& a, const Aabb& b) {
  return (a.lo.array() <= b.hi.array()).all() && (b.lo.array() <= a.hi.array()).all();
}

/// The box of a triangle, by the places of bodies.
template <class PlaceOf>
Aabb boxOf(const std::array<int, 3>& corners, const PlaceOf& placeOf) {
  const Vec3 &p = placeOf(corners[0]), &q = placeOf(corners[1]), &r = placeOf(corners[2]);
  return {p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r)};
}

/// Calls visit(item) for every item of a tree whose box meets another; `boxes` are those of its
/// nodes.
template <class Visit>
void forMet(const BoxTree& tree, std::span<const Aabb> boxes, const Aabb& box, const Visit& visit) {
  const BoxTree::Nodes& nodes = tree.nodes();
  for (std::size_t k = 0; k < nodes.size();) {
    const BoxTree::Node& node = nodes[k];
    const bool met = meet(boxes[k], box);
    if (met && node.item >= 0) visit(node.item);
    k = met ? k + 1 : static_cast<std::size_t>(node.past);
  }
}

}  // namespace

ClothCrossings::ClothCrossings(const Model& model) {
  for (const Force& force : model.def.forces)
    if (const Bending* bending = std::get_if<Bending>(&force))
      for (const std::array<int, 3>& corners : bending->body->sheet.triangles) {
        triangles_.push_back(corners);
        for (int k = 0; k < 3; ++k)
          edges_.emplace_back(std::minmax(corners[k], corners[(k + 1) % 3]));
      }
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  std::vector<Aabb> boxes;
  for (const std::array<int, 3>& corners : triangles_)
    boxes.push_back(
        boxOf(corners, [&](int i) -> const Vec3& { return model.def.bodies[i].position; }));
  tree_ = BoxTree(boxes);
}

long ClothCrossings::count(std::span<const Recorded> states) const {
  const auto placeOf = [&](int i) -> const Vec3& { return states[i].x; };
  const BoxTree::Nodes& nodes = tree_.nodes();
  std::vector<Aabb> boxes(nodes.size());
  for (std::size_t k = nodes.size(); k-- > 0;) {
    const BoxTree::Node& node = nodes[k];
    if (node.item >= 0) {
      boxes[k] = boxOf(triangles_[node.item], placeOf);
      continue;
    }
    const Aabb &a = boxes[node.first], &b = boxes[node.last];
    boxes[k] = {a.lo.cwiseMin(b.lo), a.hi.cwiseMax(b.hi)};
  }
  long found = 0;
  for (const auto& edge : edges_) {
    const int p = edge.first, q = edge.second;
    const Vec3 &from = states[p].x, &to = states[q].x;
    forMet(tree_, boxes, {from.cwiseMin(to), from.cwiseMax(to)}, [&](int item) {
      const std::array<int, 3>& t = triangles_[item];
      if (std::count(t.begin(), t.end(), p) + std::count(t.begin(), t.end(), q) > 0) return;
      found += pierces(from, to, states[t[0]].x, states[t[1]].x, states[t[2]].x);
    });
  }
  return found;
}

}  // namespace tumble
