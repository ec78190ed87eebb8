// Whether forces from given cones can balance a load.
#pragma once

#include "sim/math/vec.h"

namespace tumble {

/// How far a load is from the cone that the columns of a matrix span: min |w − G x| / |w|, x ≥ 0.
/// Lawson & Hanson, Solving Least Squares Problems, 1974, chapter 23 (NNLS). Departure: none.
/// @param generators  G, a generator each column
/// @param w           load, not zero
/// @return 0, to rounding, if forces along the generators can balance it.
double coneDistance(const MatX& generators, const VecX& w);

}  // namespace tumble
