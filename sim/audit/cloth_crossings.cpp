#include "sim/audit/cloth_crossings.h"

#include <algorithm>

#include "sim/math/orientation.h"
#include "sim/shape/box_tree.h"

namespace tumble {
namespace {

bool meet(const Aabb& a, const Aabb& b) {
  return (a.lo.array() <= b.hi.array()).all() && (b.lo.array() <= a.hi.array()).all();
}

/// Calls visit(item) for every item of a tree whose box meets another.
template <class Visit>
void forMet(const BoxTree& tree, const Aabb& box, const Visit& visit) {
  const BoxTree::Nodes& nodes = tree.nodes();
  for (std::size_t k = 0; k < nodes.size();) {
    const BoxTree::Node& node = nodes[k];
    const bool met = meet(node.box, box);
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
}

long ClothCrossings::count(std::span<const Recorded> states) const {
  std::vector<Aabb> boxes;
  boxes.reserve(triangles_.size());
  for (const auto& [a, b, c] : triangles_) {
    const Vec3 &p = states[a].x, &q = states[b].x, &r = states[c].x;
    boxes.push_back({p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r)});
  }
  const BoxTree tree(boxes);
  long found = 0;
  for (const auto& edge : edges_) {
    const int p = edge.first, q = edge.second;
    const Vec3 &from = states[p].x, &to = states[q].x;
    forMet(tree, {from.cwiseMin(to), from.cwiseMax(to)}, [&](int item) {
      const std::array<int, 3>& t = triangles_[item];
      if (std::count(t.begin(), t.end(), p) + std::count(t.begin(), t.end(), q) > 0) return;
      found += pierces(from, to, states[t[0]].x, states[t[1]].x, states[t[2]].x);
    });
  }
  return found;
}

}  // namespace tumble
