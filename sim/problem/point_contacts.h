// Chapter 6, problem: contacts of points that bend together with what does not move, one a point.
#pragma once

#include <optional>

#include "sim/problem/problem.h"

namespace tumble {

/// Newton's method on the velocities alone, by a factor for many of its steps. The contact of a
/// point that has no other takes what the row of the point in A (v − vStar) = Jᵀ λ leaves, so that
/// λ follows from v, and
///   λ_n = max(z_n, 0),  λ_t = z_t cut to the length mu λ_n,  z = λ − ρ u
/// are three equations for its velocity (Alart & Curnier, A mixed formulation for frictional
/// contact problems prone to Newton like solution methods, 1991). Each step takes them by the
/// pieces on which they are smooth: what sticks stops, what slides stays on its plane. The
/// rest of a step is a linear problem, symmetric but for friction that follows its normal force: a
/// Cholesky factor without that leaves a few rounds of GMRES (Saad & Schultz 1986).
/// It is cut short where more would be missing of all equations than after either of the last two
/// (Grippo, Lampariello & Lucidi, A nonmonotone line search technique for Newton's method, 1986).
/// @return nothing where there are few bodies, contacts of another kind, or more than one at a
///         point, or where the steps do not end: nothing is promised from afar
std::optional<SolveReport> solvePointContacts(const Problem& problem, const SolveSettings& settings,
                                              Solution& solution);

}  // namespace tumble
