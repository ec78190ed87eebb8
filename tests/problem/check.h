// What a solution is worth, worked out apart from the solvers and with longer numbers.
#pragma once

#include "sim/problem/problem.h"

namespace tumble::test {

/// Everything in long double (64-bit mantissa) from λ and v as they stand.
struct Worth {
  double residual =
      0.0;  ///< natural map as problem.h defines it, over the largest |J vStar + bias|
  double rounding = 0.0;  ///< what rounding of λ, v and their sums to double may leave of it
  double balance = 0.0;   ///< |v − vStar − M⁻¹ Jᵀ λ| over the largest size of its terms
  bool finite = true;
};

Worth worthOf(const Problem& problem, const Solution& solution);

}  // namespace tumble::test
