// Chapter 6, problem: what is tried where Newton's method fails.
#pragma once

#include <functional>

#include "sim/problem/problem.h"

namespace tumble {

/// Newton's method alone, as solveNewton begins with it.
using NewtonAlone =
    std::function<SolveReport(const Problem&, const SolveSettings&, Solution& solution)>;

/// Tries in turn, until one solves the problem:
///   a few sweeps  of projected Gauss–Seidel, which suit joints, if there are any, from the forces
///                 that Newton's method ended with
///   polish        from the forces that Newton's method ended with
///   more friction a path of problems from none to mu, each started from the one before
///   less room     a path from contacts that all part and do not rub to those that are asked for
///   many sweeps   from the best forces so far
/// All but the last are left out of problems of more than a few dozen contacts, as polish and paths
/// are O(n³) a step.
/// @param report  of Newton's method on `solution`
/// @return of the best answer met, which is left in the solution; never worse than the start
SolveReport lastResort(const Problem& problem, const SolveSettings& settings,
                       const NewtonAlone& newton, const SolveReport& report, Solution& solution);

}  // namespace tumble
