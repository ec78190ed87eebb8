// Chapter 6, problem: the rows of the table of solvers.
#pragma once

#include "sim/problem/problem.h"

namespace tumble {

/// Projected Gauss–Seidel at velocity level: cone after cone is solved exactly while all others
/// keep their λ, there and back. Moreau 1988; Jean, The Non-Smooth Contact Dynamics Method, 1999,
/// §4. Departure: between sweeps Anderson mixing (see anderson.h). A start within tolerance is
/// returned as it is.
SolveReport solvePgs(const Problem& problem, const SolveSettings& settings, Solution& solution);

/// Alternating direction method of multipliers, as Douglas and Rachford's iteration of y = λ − ρ z:
///   λ = Π_K(y),  z = (λ − y)/ρ,  s = mu |z_t| n,
///   (M + ρ JᵀJ) v = M vStar + Jᵀ (λ + ρ (z − bias − s)),  y ← λ − ρ (1.6 (J v + bias + s) − 0.6
///   z),
/// with one factor for all iterations, and Anderson mixing. Carpentier, Le Lidec & Montaut, From
/// Compliant to Rigid Contact Simulation, 2024; de Saxcé & Feng 1998 for s.
SolveReport solveAdmm(const Problem& problem, const SolveSettings& settings, Solution& solution);

/// Dense Dantzig pivoting (see lcp.h): pushing and equality rows at once, friction by a fixed point
/// around them that ends on the true cone. O(n³) for n rows: for small problems. It starts from
/// λ = 0 whatever the solution holds, and caps its own passes, not by maxIterations.
SolveReport solvePivoting(const Problem& problem, const SolveSettings& settings,
                          Solution& solution);

/// Proximal augmented Lagrangian. In stages λ ← Π_K(λ − ρ(u + s)), where v minimises the convex
///   Φ(v) = ½ |v − v*|²_A + Σ |Π_K(λ − ρ(J v + bias + s))|² / 2ρ
/// by Newton's method with H = A + ρ Jᵀ ∂Π J, a matrix of 6 × 6 blocks on the graph of bodies, or
/// of 3 × 3 where no row turns one; A is M, and couplings add edges to that graph: points that
/// depend on each other make it neither larger nor singular. The first stages go with cones of 0.8
/// mu: of the many λ that hold what sticks, one that lies inside its cones is found, if there is
/// one, and rounding does not move it from piece to piece. s = mu |u_t| n follows from stage to
/// stage, which makes the cone Coulomb's (de Saxcé & Feng 1998; Rockafellar 1976; Acary, Brémond &
/// Huber 2018). ρ is one for the whole problem. It starts from λ = 0 whatever the solution holds,
/// and from solution.v if that is of the right length; a problem with couplings, whose forces are
/// not chosen among many, from solution.lambda too.
///
/// Which forces, where several solve the problem: those of contact points, and rows of joints, of
/// one compliance ε in all directions, without a load at first, in the limit ε → 0, where there is
/// one. Each cone obeys its law with u + ε λ in place of u:
///   λn = max(0, −un/ε),   λt = −ut/ε, cut to the length mu λn;   λ = −u/ε of an equality.
/// So λ = −J δ with one small motion δ of all bodies: under a face that sticks or slides the
/// pressure is linear in place; of equalities, and of what sticks well inside its cones, Σ λ² is
/// the least that balances; a fit between two walls that nothing presses together does not hold. It
/// depends on no order, frame or history. A row that turns bodies and does not move them counts as
/// at an arm of √(1/(m w)), with w its mobility and 1/m = 1/ma + 1/mb. Forces of one stage after
/// the other stay of this kind until one of them changes its piece; then they are looked for anew
/// (newton_springs.cpp). Where they are not found the first answer stands, and so it does in a
/// problem with couplings: points of mass that something bends joins have contacts of their own.
SolveReport solveNewton(const Problem& problem, const SolveSettings& settings, Solution& solution);

}  // namespace tumble
