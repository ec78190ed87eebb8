// Chapter 6, problem: one contact alone, which has a closed form but for the direction of its slip.
#pragma once

#include <optional>

#include "sim/problem/problem.h"

namespace tumble {

/// Solves a problem of one Push or one Friction cone. v is what λ gives: balance 0.
/// @return nothing if the problem has other cones, or its residual stays above the tolerance;
///         `solution` is then as before
std::optional<SolveReport> solveSingle(const Problem& problem, double tolerance,
                                       Solution& solution);

}  // namespace tumble
