// Chapter 5, collide: near pairs from sorted interval ends (slide SD40: O(n), not O(n log n)).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "sim/shape/shape.h"

namespace tumble {

/// Persistent sweep and prune on three axes: interval ends stay sorted from call to call by
/// insertion sort, and a pair is kept while its intervals overlap on all three. The cost of a call
/// is O(n + swaps); of n boxes that move through a cube, about n^(2/3) ends pass each by in a step.
class SortedEnds {
 public:
  using Pair = std::pair<int, int>;

  /// Pairs (i, j), i < j, of boxes [m] that overlap or touch, sorted, whatever the history; a
  /// changed number of boxes starts afresh.
  void update(std::span<const Aabb> boxes, std::vector<Pair>& pairs);

  /// Neighbouring interval ends exchanged in the last update: what it cost beyond O(n).
  long swaps() const { return swaps_; }

 private:
  struct End {
    double value;
    int box;
    bool isLower;
  };
  static bool before(const End& a, const End& b);
  void startAfresh(std::span<const Aabb> boxes);
  void sortAxis(int axis, std::span<const Aabb> boxes);
  void noteSwap(const End& moved, const End& passed, std::span<const Aabb> boxes);
  void mergeChanges();

  std::vector<End> ends_[3];
  std::vector<Aabb> last_;  ///< boxes of the last call
  std::vector<Pair> pairs_;
  std::vector<Pair> begun_, ended_;  ///< changes of this call
  long swaps_ = 0;

  // Scratch, to allocate nothing once warm.
  std::vector<Pair> merged_;
  std::vector<int> open_;
  std::vector<std::size_t> place_;  ///< of each open box
};

}  // namespace tumble
