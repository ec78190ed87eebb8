#include "sim/audit/cloth_crossings.h"

#include <algorithm>
#include <set>

#include "sim/math/orientation.h"

namespace tumble {
namespace {

/// Whether what is in two boxes may pass through each other's inside: boxes that only touch hold
/// nothing that does.
bool mayPierce(const Aabb& a, const Aabb& b) {
  return (a.lo.array() < b.hi.array()).all() && (b.lo.array() < a.hi.array()).all();
}

/// The box of a triangle, by the places of bodies.
template <class PlaceOf>
Aabb boxOf(const std::array<int, 3>& corners, const PlaceOf& placeOf) {
  const Vec3 &p = placeOf(corners[0]), &q = placeOf(corners[1]), &r = placeOf(corners[2]);
  return {p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r)};
}

}  // namespace

/// One count: down the tree, of every two triangles whose boxes overlap.
class ClothCrossings::Count {
 public:
  Count(const ClothCrossings& cloths, std::span<const Recorded> states)
      : cloths_(cloths), nodes_(cloths.tree_.nodes()), states_(states), boxes_(nodes_.size()) {
    const auto placeOf = [&](int i) -> const Vec3& { return states_[i].x; };
    for (std::size_t k = nodes_.size(); k-- > 0;) {
      const BoxTree::Node& node = nodes_[k];
      if (node.item >= 0) {
        boxes_[k] = boxOf(cloths_.triangles_[node.item].corners, placeOf);
        continue;
      }
      const Aabb &a = boxes_[node.first], &b = boxes_[node.last];
      boxes_[k] = {a.lo.cwiseMin(b.lo), a.hi.cwiseMax(b.hi)};
    }
  }

  long within(int k) const {
    const BoxTree::Node& node = nodes_[k];
    if (node.item >= 0) return 0;
    return within(node.first) + within(node.last) + between(node.first, node.last);
  }

 private:
  long between(int i, int j) const {
    if (!mayPierce(boxes_[i], boxes_[j])) return 0;
    const BoxTree::Node &p = nodes_[i], &q = nodes_[j];
    if (p.item >= 0 && q.item >= 0) return through(p.item, j) + through(q.item, i);
    if (opensFirst(p, q)) return between(p.first, j) + between(p.last, j);
    return between(i, q.first) + between(i, q.last);
  }

  /// How many edges that a triangle owns pass through that of a leaf.
  long through(int item, int leaf) const {
    const Triangle& from = cloths_.triangles_[item];
    const auto [a, b, c] = cloths_.triangles_[nodes_[leaf].item].corners;
    long found = 0;
    for (int k = 0; k < 3; ++k) {
      const int p = from.corners[k], q = from.corners[(k + 1) % 3];
      if (!from.owns[k] || p == a || p == b || p == c || q == a || q == b || q == c) continue;
      const Vec3 &x = states_[p].x, &y = states_[q].x;
      if (mayPierce({x.cwiseMin(y), x.cwiseMax(y)}, boxes_[leaf]))
        found += pierces(x, y, states_[a].x, states_[b].x, states_[c].x);
    }
    return found;
  }

  const ClothCrossings& cloths_;
  const BoxTree::Nodes& nodes_;
  std::span<const Recorded> states_;
  std::vector<Aabb> boxes_;
};

ClothCrossings::ClothCrossings(const Model& model) {
  std::set<std::pair<int, int>> edges;
  std::vector<Aabb> boxes;
  for (const Force& force : model.def.forces)
    if (const Bending* bending = std::get_if<Bending>(&force))
      for (const std::array<int, 3>& corners : bending->body->sheet.triangles) {
        Triangle& triangle = triangles_.emplace_back(Triangle{corners});
        for (int k = 0; k < 3; ++k)
          triangle.owns[k] = edges.insert(std::minmax(corners[k], corners[(k + 1) % 3])).second;
        boxes.push_back(
            boxOf(corners, [&](int i) -> const Vec3& { return model.def.bodies[i].position; }));
      }
  tree_ = BoxTree(boxes);
}

long ClothCrossings::count(std::span<const Recorded> states) const {
  return any() ? Count(*this, states).within(0) : 0;
}

}  // namespace tumble
