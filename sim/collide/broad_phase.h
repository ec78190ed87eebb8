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
  using Pair = std::pair<int, int>;

  /// Brings the pairs up to date with the boxes [m], lo ≤ hi; a changed number of boxes starts
  /// afresh.
  void update(std::span<const Aabb> boxes);

  /// Pairs (i, j), i < j, whose boxes overlap or touch; sorted, the same whatever the history.
  const std::vector<Pair>& pairs() const { return pairs_; }

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
  std::vector<Pair> merged_;         ///< scratch, to allocate nothing once warm
  long swaps_ = 0;
};

}  // namespace tumble
