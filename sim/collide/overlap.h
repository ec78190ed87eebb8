// Chapter 5, collide: whether two convex parts share a volume, whatever they are.
#pragma once

#include <utility>

#include "sim/shape/shape.h"

namespace tumble {

/// True if two parts of a compound overlap by more than rounding (1e-9 of their size); parts that
/// touch do not.
bool overlap(const Part& a, const Part& b);

/// The first two parts of a compound that overlap, counted from 0; {−1, −1} if none do.
std::pair<int, int> overlappingParts(const Compound& compound);

}  // namespace tumble
