// Chapter 5, collide: the table of broad phases.
#include "sim/collide/broad_phase.h"

namespace tumble {
namespace {

using Boxes = std::span<const Aabb>;
using Pairs = std::vector<BroadPhase::Pair>;

void updateAll(BroadPhase::Memory&, Boxes boxes, std::span<const char>, Pairs& pairs) {
  pairs.clear();
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j)
      if (boxes[i].overlaps(boxes[j])) pairs.emplace_back(static_cast<int>(i), static_cast<int>(j));
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

// Up to this many boxes, looking at every pair costs less (0.6 µs of 30 boxes, the grid 0.9; of
// 100, 7 µs and 3): tests/bench/sim/broad_phase.cpp.
constexpr std::size_t kFewBoxes = 32;

}  // namespace

std::span<const BroadPhaseRow> broadPhaseRows() {
  return kRows;
}

const BroadPhaseRow& chooseBroadPhase(std::size_t boxes) {
  return boxes <= kFewBoxes ? kRows[0] : kRows[2];
}

void BroadPhase::update(std::span<const Aabb> boxes, std::span<const char> apart) {
  const BroadPhaseRow& row = only_ ? *only_ : chooseBroadPhase(boxes.size());
  row.update(memory_, boxes, apart, pairs_);
}

}  // namespace tumble
