// When something that falls no faster than a parabola can first arrive.
#pragma once

#include <cmath>
#include <limits>

namespace tumble {

/// The first s ≥ 0 at which  alpha + beta s + ½ c s²  is 0 or would fall below it; infinity if it
/// never does. alpha ≥ 0; a start at 0 counts only if it does not rise from there.
/// Written so that nothing cancels:  2 alpha/(−beta + √(beta² − 2 alpha c))  for beta ≤ 0.
inline double firstZero(double alpha, double beta, double c) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (alpha == 0.0) {
    if (beta < 0.0 || (beta == 0.0 && c <= 0.0)) return 0.0;
    return c < 0.0 ? -2.0 * beta / c : kNever;
  }
  const double discriminant = beta * beta - 2.0 * alpha * c;
  if (discriminant < 0.0 || (beta >= 0.0 && c >= 0.0)) return kNever;
  const double root = std::sqrt(discriminant);
  return beta <= 0.0 ? 2.0 * alpha / (root - beta) : -(beta + root) / c;
}

}  // namespace tumble
