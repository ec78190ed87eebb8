// Chapter 5, collide: which pairs of bodies are near enough to be worth a closer look (slide SD40).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "sim/shape/shape.h"

namespace tumble {

/// Persistent sweep and prune on three axes: interval ends stay sorted from call to call by
/// insertion sort, and a pair is kept while its intervals overlap on all three. The cost of a call
/// is O(n + swaps). Boxes that reach to infinity (half-spaces) are allowed.
class BroadPhase {
 public:
  /// Brings the pairs up to date with the boxes [m]; a changed number of boxes starts afresh.
  void update(std::span<const Aabb> boxes);

  /// Pairs (i, j), i < j, whose boxes overlap or touch; sorted, the same whatever the history.
  const std::vector<std::pair<int, int>>& pairs() const { return pairs_; }

 private:
  struct End {
    double value;
    int box;
    bool isLower;
  };
  std::vector<End> ends_[3];
  std::vector<std::pair<int, int>> pairs_;
};

}  // namespace tumble
