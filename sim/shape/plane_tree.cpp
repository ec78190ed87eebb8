#include "sim/shape/plane_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace tumble {
namespace {

constexpr int kLeaf = 4;         // planes looked at one by one
constexpr int kDepth = 32;       // levels of halves of what an int counts
constexpr double kSlip = 1e-14;  // of the size of a height: more than its rounding

}  // namespace

PlaneTree::PlaneTree(std::vector<HalfSpace> planes)
    : planes_(std::move(planes)), order_(planes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!planes_.empty()) build(0, static_cast<int>(planes_.size()));
}

int PlaneTree::build(int from, int to) {
  const auto plane = [&](int i) -> const HalfSpace& {
    return planes_[static_cast<std::size_t>(i)];
  };
  const HalfSpace& some = plane(order_[static_cast<std::size_t>(from)]);
  Node node{some.n, some.n, some.d, some.n.lpNorm<1>(), from, to};
  const auto begin = order_.begin() + from, end = order_.begin() + to;
  for (auto i = begin; i != end; ++i) {
    const HalfSpace& here = plane(*i);
    node.lo = node.lo.cwiseMin(here.n);
    node.hi = node.hi.cwiseMax(here.n);
    node.least = std::min(node.least, here.d);
    node.across = std::min(node.across, here.n.lpNorm<1>());
  }
  const int own = static_cast<int>(nodes_.size());
  nodes_.push_back(node);
  if (to - from <= kLeaf) return own;
  int axis = 0;
  (node.hi - node.lo).maxCoeff(&axis);
  const int middle = from + (to - from) / 2;
  std::nth_element(begin, order_.begin() + middle, end, [&](int i, int j) {
    const double a = plane(i).n[axis], b = plane(j).n[axis];
    return a != b ? a < b : i < j;
  });
  build(from, middle);
  const int second = build(middle, to);
  nodes_[static_cast<std::size_t>(own)].second = second;
  return own;
}

double PlaneTree::highest(const Node& node, const Vec3& p) const {
  const double most = node.lo.cwiseProduct(p).cwiseMax(node.hi.cwiseProduct(p)).sum();
  return most - node.least + kSlip * (p.lpNorm<1>() + std::abs(node.least));
}

template <class Opens, class Visit>
bool PlaneTree::any(const Opens& opens, const Visit& visit) const {
  if (nodes_.empty()) return false;
  int open[kDepth] = {0}, count = 1;
  while (count > 0) {
    const int index = open[--count];
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    ++looks_;
    if (!opens(node)) continue;
    if (node.second >= 0) {
      open[count++] = node.second;
      open[count++] = index + 1;
      continue;
    }
    looks_ += node.to - node.from;
    for (int k = node.from; k < node.to; ++k)
      if (visit(order_[static_cast<std::size_t>(k)])) return true;
  }
  return false;
}

void PlaneTree::above(const Vec3& p, double least, std::vector<int>& found) const {
  // Marked, and the marks read in their order.
  marks_.resize((planes_.size() + 63) / 64);
  any([&](const Node& node) { return highest(node, p) > least; },
      [&](int i) {
        const HalfSpace& plane = planes_[static_cast<std::size_t>(i)];
        if (plane.n.dot(p) - plane.d > least)
          marks_[static_cast<std::size_t>(i) / 64] |= std::uint64_t{1} << (i % 64);
        return false;
      });
  found.clear();
  for (std::size_t word = 0; word < marks_.size(); ++word)
    for (std::uint64_t& mark = marks_[word]; mark != 0; mark &= mark - 1)
      found.push_back(static_cast<int>(64 * word) + std::countr_zero(mark));
}

bool PlaneTree::isOver(const Vec3& p, double half) const {
  return any(
      [&](const Node& node) { return highest(node, p) > half * (1.0 - kSlip) * node.across; },
      [&](int i) {
        const HalfSpace& plane = planes_[static_cast<std::size_t>(i)];
        return plane.n.dot(p) - plane.d > half * plane.n.lpNorm<1>();
      });
}

}  // namespace tumble
