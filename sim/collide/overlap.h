// Chapter 5, collide: whether two convex parts share a volume, whatever they are.
#pragma once

#include <utility>

#include "sim/shape/shape.h"

namespace tumble {

/// True if two parts of a compound overlap by more than rounding (1e-9 of their size); parts that
/// touch do not. Gilbert, Johnson and Keerthi, "A fast procedure for computing the distance between
/// complex objects in three-dimensional space", 1988: the point of the difference of both that is
/// nearest to the origin, from at most four of its outermost points at a time.
bool overlap(const Part& a, const Part& b);

/// The first two parts of a compound that overlap, counted from 0; {−1, −1} if none do.
std::pair<int, int> overlappingParts(const Compound& compound);

}  // namespace tumble
