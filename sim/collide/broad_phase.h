// Chapter 5, collide: which pairs of bodies are near enough to be worth a closer look (slide SD40).
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/collide/cell_grid.h"
#include "sim/collide/sorted_ends.h"
#include "sim/shape/shape.h"

namespace tumble {

struct BroadPhaseRow;

/// Finds the pairs of boxes that overlap. Boxes may reach to infinity (half-spaces).
class BroadPhase {
 public:
  using Pair = std::pair<int, int>;

  /// Takes the row of the table that costs least for the boxes, by their number.
  BroadPhase() = default;
  /// Always takes one row.
  explicit BroadPhase(const BroadPhaseRow& row) : only_(&row) {}

  /// Brings the pairs up to date with the boxes [m], lo ≤ hi. Allocates nothing once warm.
  /// @param apart  per box whether it is asked after only with those for which this does not hold:
  ///               pairs of two for which it does may be left out; or empty
  void update(std::span<const Aabb> boxes, std::span<const char> apart = {});

  /// Pairs (i, j), i < j, whose boxes overlap or touch; sorted, the same whatever the history and
  /// the row.
  const std::vector<Pair>& pairs() const { return pairs_; }

  /// What the rows remember from call to call.
  struct Memory {
    SortedEnds ends;
    CellGrid grid;
    std::vector<int> others;  ///< boxes that are not told apart
  };
  const Memory& memory() const { return memory_; }

 private:
  const BroadPhaseRow* only_ = nullptr;
  Memory memory_;
  std::vector<Pair> pairs_;
};

/// A way to find the pairs.
struct BroadPhaseRow {
  std::string_view name, what;
  void (*update)(BroadPhase::Memory&, std::span<const Aabb>, std::span<const char> apart,
                 std::vector<BroadPhase::Pair>&);
};

/// The table, and the row that `BroadPhase` takes for so many boxes, of which some are told apart.
std::span<const BroadPhaseRow> broadPhaseRows();
const BroadPhaseRow& chooseBroadPhase(std::size_t boxes, std::size_t apart);

}  // namespace tumble
