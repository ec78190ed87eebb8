// Chapter 6, problem: the rows of the table of solvers.
#pragma once

#include "sim/problem/problem.h"

namespace tumble {

/// Projected Gauss–Seidel at velocity level: cone after cone is solved exactly while all others
/// keep their λ, there and back. Moreau 1988; Jean, The Non-Smooth Contact Dynamics Method, 1999,
/// §4. Departure: between sweeps Anderson mixing (see anderson.h). A start within tolerance is
/// returned as it is.
SolveReport solvePgs(const Problem& problem, const SolveSettings& settings, Solution& solution);

/// Dense Dantzig pivoting (see lcp.h): pushing and equality rows at once, friction by a fixed point
/// around them that ends on the true cone. O(n³) for n rows: for small problems. It starts from
/// λ = 0 whatever the solution holds, and caps its own passes, not by maxIterations.
SolveReport solvePivoting(const Problem& problem, const SolveSettings& settings,
                          Solution& solution);

}  // namespace tumble
