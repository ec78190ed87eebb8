// Chapter 2, shape: a tree of boxes over the parts or the faces of one body (slides SH28, SH29:
// root, middle and leaf boxes). Two trees are descended at once; most pairs go at a high level.
#pragma once

#include <boost/container/small_vector.hpp>
#include <span>
#include <vector>

#include "sim/shape/shape.h"

namespace tumble {

/// Where the frame of b stands in the frame of a: p_A = R p_B + x.
struct Seat {
  Mat3 R = Mat3::Identity();
  Vec3 x = Vec3::Zero();  ///< [m]
};
Seat seatOf(const Pose& a, const Pose& b);

/// Lower bound [m] of the distance between a box of a and a box of b, each along the axes of its
/// own body: the widest slab across the six axes of both (Gottschalk, Lin and Manocha, "OBBTree",
/// 1996, §5; departure: without the nine products of axes). < 0 if none parts them.
double gapOf(const Aabb& a, const Aabb& b, const Seat& seat);

/// Boxes of items halved by their middles along the longest side, until each stands alone.
class BoxTree {
 public:
  struct Node {
    Aabb box;
    int item = -1;              ///< of a leaf
    int first = -1, last = -1;  ///< children
    int parent = -1;            ///< −1 of the root
    int past = 0;               ///< all below it, and itself, are from its own index to before this
    int level = 0;              ///< 0: the root
  };

  using Nodes = boost::container::small_vector<Node, 1>;

  BoxTree() = default;
  explicit BoxTree(std::span<const Aabb> items);

  /// None without items; else the root is the first.
  const Nodes& nodes() const { return nodes_; }
  bool empty() const { return nodes_.empty(); }

 private:
  int build(std::span<const Aabb> items, std::span<int> order, int parent);

  Nodes nodes_;
};

/// Whether the box of a is opened when two are descended, not that of b: the larger one is.
bool opensFirst(const BoxTree::Node& a, const BoxTree::Node& b);

/// Pairs of boxes looked at, and those not parted, by the deeper of their two levels.
struct Survivors {
  std::vector<long> tested, left;
  void see(int level, bool survives);
};

namespace tree {

/// No pair of boxes is passed over.
struct NoSkip {
  bool operator()(int, int) const { return false; }
};

template <class Visit, class Skip>
void descend(const BoxTree& a, int i, const BoxTree& b, int j, const Seat& seat,
             const double& reach, Survivors* count, const Visit& visit, const Skip& skip) {
  if (skip(i, j)) return;
  const BoxTree::Node &p = a.nodes()[static_cast<std::size_t>(i)],
                      &q = b.nodes()[static_cast<std::size_t>(j)];
  if (p.item >= 0 && q.item >= 0) return visit(p.item, q.item);
  // The nearer half first.
  const bool openA = opensFirst(p, q);
  struct Child {
    int i, j;
    double gap;
  } child[2];
  for (int k = 0; k < 2; ++k) {
    child[k].i = openA ? (k == 0 ? p.first : p.last) : i;
    child[k].j = openA ? j : (k == 0 ? q.first : q.last);
    const BoxTree::Node &u = a.nodes()[static_cast<std::size_t>(child[k].i)],
                        &v = b.nodes()[static_cast<std::size_t>(child[k].j)];
    child[k].gap = gapOf(u.box, v.box, seat);
    if (count) count->see(u.level > v.level ? u.level : v.level, child[k].gap <= reach);
  }
  const int near = child[1].gap < child[0].gap ? 1 : 0;
  for (const int k : {near, 1 - near})
    if (child[k].gap <= reach)
      descend(a, child[k].i, b, child[k].j, seat, reach, count, visit, skip);
}

}  // namespace tree

/// Calls visit(item of a, item of b) for all pairs whose boxes are within `reach` [m], which visit
/// may shorten on the way. Nearer ones tend to come first. What is below a pair of boxes of which
/// skip(index of a, index of b) holds is passed over.
template <class Visit, class Skip = tree::NoSkip>
void forNear(const BoxTree& a, const BoxTree& b, const Seat& seat, const double& reach,
             const Visit& visit, Survivors* count = nullptr, const Skip& skip = {}) {
  if (a.empty() || b.empty()) return;
  const bool near = gapOf(a.nodes()[0].box, b.nodes()[0].box, seat) <= reach;
  if (count) count->see(0, near);
  if (near) tree::descend(a, 0, b, 0, seat, reach, count, visit, skip);
}

}  // namespace tumble
