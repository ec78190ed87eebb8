#include "sim/shape/box_tree.h"

#include <algorithm>
#include <numeric>

#include "sim/math/rotation.h"

namespace tumble {

Seat seatOf(const Pose& a, const Pose& b) {
  const Mat3 turn = a.q.toRotationMatrix().transpose();
  return {turn * b.q.toRotationMatrix(), turn * (b.x - a.x)};
}

double gapOf(const Aabb& a, const Aabb& b, const Seat& seat) {
  const Vec3 halfA = 0.5 * (a.hi - a.lo), halfB = 0.5 * (b.hi - b.lo);
  const Vec3 way = seat.R * (0.5 * (b.lo + b.hi)) + seat.x - 0.5 * (a.lo + a.hi);
  const Mat3 size = seat.R.cwiseAbs();
  const double acrossA = (way.cwiseAbs() - halfA - size * halfB).maxCoeff();
  const double acrossB =
      ((seat.R.transpose() * way).cwiseAbs() - halfB - size.transpose() * halfA).maxCoeff();
  return std::max(acrossA, acrossB);
}

BoxTree::BoxTree(std::span<const Aabb> items) {
  if (items.empty()) return;
  nodes_.reserve(2 * items.size() - 1);
  std::vector<int> order(items.size());
  std::iota(order.begin(), order.end(), 0);
  build(items, order, -1);
}

int BoxTree::build(std::span<const Aabb> items, std::span<int> order, int parent) {
  const int own = static_cast<int>(nodes_.size());
  Node node{items[static_cast<std::size_t>(order[0])]};
  node.parent = parent;
  node.past = own + 1;
  node.level = parent < 0 ? 0 : nodes_[static_cast<std::size_t>(parent)].level + 1;
  for (const int i : order) {
    const Aabb& box = items[static_cast<std::size_t>(i)];
    node.box = {node.box.lo.cwiseMin(box.lo), node.box.hi.cwiseMax(box.hi)};
  }
  if (order.size() == 1) node.item = order[0];
  nodes_.push_back(node);
  if (order.size() == 1) return own;

  int axis = 0;
  (node.box.hi - node.box.lo).maxCoeff(&axis);
  const auto middle = [&](int i) {
    const Aabb& box = items[static_cast<std::size_t>(i)];
    return box.lo[axis] + box.hi[axis];
  };
  std::sort(order.begin(), order.end(),
            [&](int i, int j) { return middle(i) != middle(j) ? middle(i) < middle(j) : i < j; });
  const std::size_t half = order.size() / 2;
  const int first = build(items, order.first(half), own);
  const int last = build(items, order.subspan(half), own);
  Node& built = nodes_[static_cast<std::size_t>(own)];
  built.first = first;
  built.last = last;
  built.past = static_cast<int>(nodes_.size());
  return own;
}

bool opensFirst(const BoxTree::Node& a, const BoxTree::Node& b) {
  if (a.item >= 0 || b.item >= 0) return a.item < 0;
  return (a.box.hi - a.box.lo).squaredNorm() >= (b.box.hi - b.box.lo).squaredNorm();
}

void Survivors::see(int level, bool survives) {
  const auto k = static_cast<std::size_t>(level);
  if (tested.size() <= k) tested.resize(k + 1, 0), left.resize(k + 1, 0);
  ++tested[k];
  if (survives) ++left[k];
}

}  // namespace tumble
