// Chapter 2, shape: half-spaces in a tree, so that few of many are looked at.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/shape/shape.h"

namespace tumble {

/// Half-spaces n·p ≤ d, halved by their normals until few are left together. The height of a point
/// over those of one node, n·p − d, is no more than that over the corner of the box of their
/// normals that looks most its way.
class PlaneTree {
 public:
  explicit PlaneTree(std::vector<HalfSpace> planes);

  const std::vector<HalfSpace>& planes() const { return planes_; }

  /// The planes over which p is higher than `least` [m], by their index, in ascending order.
  void above(const Vec3& p, double least, std::vector<int>& found) const;

  /// Whether p is over any plane, by more than half the extent of a cube along its normal.
  /// @param half  [m] of the cube's edge; 0: a point
  bool isOver(const Vec3& p, double half) const;

  /// Nodes and planes looked at so far.
  long looks() const { return looks_; }

 private:
  struct Node {
    Vec3 lo, hi;      ///< box of the normals
    double least;     ///< [m] smallest d
    double across;    ///< smallest sum |nx| + |ny| + |nz|
    int from, to;     ///< of order_
    int second = -1;  ///< child; the first is the next node. −1: a leaf
  };
  int build(int from, int to);
  double highest(const Node& node, const Vec3& p) const;
  /// Calls visit(i) for planes of nodes that `opens` lets pass, until it returns true.
  template <class Opens, class Visit>
  bool any(const Opens& opens, const Visit& visit) const;

  std::vector<HalfSpace> planes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
  mutable std::vector<std::uint64_t> marks_;  ///< one bit per plane, all 0 between questions
  mutable long looks_ = 0;
};

}  // namespace tumble
