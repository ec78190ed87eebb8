// Complementarity problems in rational numbers: no rounding, and certain when there is no answer.
#pragma once

#include <optional>
#include <vector>

#include "sim/problem/problem.h"

namespace tumble::test {

/// a = A f + b of the boxed LCP of sim/problem/lcp.h, rounded once. a is unique, f need not be.
/// CGAL's quadratic programming in rationals: f minimises  ½ fᵀA f + bᵀf  over  lo ≤ f ≤ hi.
/// @param A  symmetric positive semidefinite as its doubles stand, not only up to rounding
/// @return nothing if the LCP has no solution: the minimum is −∞. Both answers are checked by the
///         certificates that come with them.
std::optional<VecX> exactAccelerations(const MatX& A, const VecX& b, const VecX& lo,
                                       const VecX& hi);

/// v of a problem of pushing and equality rows, rounded once; nothing if it has no solution.
/// J, M⁻¹, vStar and bias are taken as their doubles stand, so that J M⁻¹ Jᵀ is of its true rank.
std::optional<std::vector<Vec6>> exactMotion(const Problem& problem);

}  // namespace tumble::test
