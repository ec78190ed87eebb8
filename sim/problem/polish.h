// Chapter 6, problem: the last digits of contact forces with friction.
#pragma once

#include "sim/problem/problem.h"

namespace tumble {

/// Newton's method from λ of the solution, for the equations of Alart and Curnier: per contact
///   λn = max(0, λn − ρ un),   λt = (λt − ρ ut) cut to the length mu λn,
/// whose derivative jumps where a contact changes its mode. Where rows depend on each other the
/// least change of λ is taken. Alart and Curnier, A Mixed Formulation for Frictional Contact
/// Problems Prone to Newton Like Solution Methods, 1991. Small problems: O(n³) a pass.
/// @return of the best λ that was met, which is left in the solution; never worse than the start
SolveReport polish(const Problem& problem, const SolveSettings& settings, Solution& solution);

}  // namespace tumble
