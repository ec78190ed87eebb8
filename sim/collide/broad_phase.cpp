// Chapter 5, collide: the table of broad phases.
#include "sim/collide/broad_phase.h"

#include <algorithm>

namespace tumble {
namespace {

using Boxes = std::span<const Aabb>;
using Pairs = std::vector<BroadPhase::Pair>;

/// A box of the set that is told apart is held against the others alone.
void updateAll(BroadPhase::Memory& memory, Boxes boxes, std::span<const char> apart, Pairs& pairs) {
  const int n = static_cast<int>(boxes.size());
  std::vector<int>& others = memory.others;
  others.clear();
  for (int i = 0; i < n; ++i)
    if (apart.empty() || !apart[i]) others.push_back(i);
  pairs.clear();
  std::size_t passed = 0;
  for (int i = 0; i < n; ++i) {
    const auto test = [&](int j) {
      if (boxes[i].overlaps(boxes[j])) pairs.emplace_back(i, j);
    };
    const bool isOther = passed < others.size() && others[passed] == i;
    passed += isOther;
    if (isOther)
      for (int j = i + 1; j < n; ++j) test(j);
    else
      for (std::size_t k = passed; k < others.size(); ++k) test(others[k]);
  }
}

void updateEnds(BroadPhase::Memory& memory, Boxes boxes, std::span<const char>, Pairs& pairs) {
  memory.ends.update(boxes, pairs);
}

void updateGrid(BroadPhase::Memory& memory, Boxes boxes, std::span<const char> apart,
                Pairs& pairs) {
  memory.grid.update(boxes, apart, pairs);
}

constexpr BroadPhaseRow kRows[] = {
    {"all", "looks at every pair", updateAll},
    {"ends", "sweep and prune: interval ends kept sorted on three axes", updateEnds},
    {"grid", "cells of space, and the near pairs found there while boxes stay near", updateGrid},
};

// Up to so many pairs a box, as 32 boxes have, looking at all of them costs less (0.6 µs of 30
// boxes, the grid 0.9; of 100, 7 µs and 3): tests/bench/sim/broad_phase.cpp.
constexpr double kFewPairs = 15.5;

}  // namespace

std::span<const BroadPhaseRow> broadPhaseRows() {
  return kRows;
}

const BroadPhaseRow& chooseBroadPhase(std::size_t boxes, std::size_t apart) {
  const auto pairsOf = [](double count) { return 0.5 * count * (count - 1.0); };
  const auto all = static_cast<double>(boxes), told = static_cast<double>(apart);
  return pairsOf(all) - pairsOf(told) <= kFewPairs * all ? kRows[0] : kRows[2];
}

void BroadPhase::update(std::span<const Aabb> boxes, std::span<const char> apart) {
  const auto toldApart = static_cast<std::size_t>(std::count(apart.begin(), apart.end(), 1));
  const BroadPhaseRow& row = only_ ? *only_ : chooseBroadPhase(boxes.size(), toldApart);
  row.update(memory_, boxes, apart, pairs_);
}

}  // namespace tumble
