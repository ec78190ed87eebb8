// Chapter 5, collide: overlapping boxes found from nothing, for boxes that have no past (slide
// SD40).
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sim/shape/shape.h"

namespace tumble {

/// What a sweep may cost, and what it has cost.
struct SweepCount {
  long pairs = 0, comparisons = 0;
};

/// Pairs (i, j), i < j, of boxes [m] that overlap or touch, sorted: the boxes are sorted along x,
/// and each is compared with those that begin before it ends. `BroadPhase` is the one for boxes
/// that move a little from call to call.
/// @param most    gives up as soon as it would exceed either number
/// @param pairs   cleared first; incomplete where it gave up
/// @return what it cost, or nothing if it gave up
std::optional<SweepCount> sweepPairs(std::span<const Aabb> boxes, const SweepCount& most,
                                     std::vector<std::pair<int, int>>& pairs);

}  // namespace tumble
