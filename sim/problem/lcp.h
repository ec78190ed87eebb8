// Chapter 6, problem: the linear complementarity problem of resting contact (slides SD47–SD57).
#pragma once

#include "sim/math/vec.h"
#include "sim/problem/problem.h"

namespace tumble {

/// What became of an LCP.
struct LcpReport {
  SolveStatus status = SolveStatus::Solved;
  double residual = 0.0;  ///< worst violation in units of a, over the largest |b|
  int pivots = 0;
};

/// Finds f with  a = A f + b,  lo ≤ f ≤ hi,  and per index
///   a ≥ 0 where f = lo,   a ≤ 0 where f = hi,   a = 0 between.
/// Dantzig pivoting: indices are taken in one by one; each is driven until its own condition holds,
/// and the others move so that theirs keep holding. Cottle & Dantzig 1968; Baraff, Fast Contact
/// Force Computation for Nonpenetrating Rigid Bodies, 1994, §4. Departures: bounds on both sides,
/// and what rounding spoils is driven again. A of deficient rank leaves f open: here each index
/// stands on a foot of the same small compliance, and of all answers the even one is found. The
/// feet are then taken away by a proximal point iteration, so that a = A f + b holds to rounding.
/// Only where that fails are indices that depend on the free ones kept out of the factor instead.
/// @param A   symmetric positive semidefinite, of any rank
/// @param lo  may be −∞; lo = −∞, hi = +∞ makes an equality a = 0
/// @param f   result; always finite and within its bounds
/// @return Infeasible if some index can be driven for ever without its condition coming true, or f
///         has grown along a direction that moves nothing and gains for ever (f is then the best
///         point reached); NotConverged if the cap on pivots ended it. What rounding is taken to
///         excuse in a solution stays below 1e-6 of the largest |b|.
LcpReport solveLcp(const MatX& A, const VecX& b, const VecX& lo, const VecX& hi, VecX& f);

}  // namespace tumble
