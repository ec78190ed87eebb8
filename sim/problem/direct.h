// Chapter 6, problem: what needs no search – one contact alone, and equalities alone.
#pragma once

#include <optional>

#include "sim/problem/problem.h"

namespace tumble {

/// Solves a problem of one Push or one Friction cone, which has a closed form but for the direction
/// of its slip; or of few Equality cones, which is linear. v is what λ gives: balance 0.
/// @return nothing for any other problem, or where the residual stays above the tolerance and above
///         rounding; `solution` is then as before
std::optional<SolveReport> solveDirect(const Problem& problem, const SolveSettings& settings,
                                       Solution& solution);

}  // namespace tumble
