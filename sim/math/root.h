// Chapter 0, math: where something changes – two ways to shrink a bracket around it.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace tumble {

/// The width [s] of a bracket around an instant near t [s] below which no clock tells its ends
/// apart.
inline double instantNear(double t) {
  constexpr double kInstant = 1e-15;  // [s]
  return std::max(kInstant, std::numeric_limits<double>::epsilon() * t);
}

/// Two ends, one on either side of a change: `lo` shows the first state, `hi` the second.
struct Bracket {
  double lo = 0.0, hi = 0.0;
  double width() const { return hi - lo; }
};

/// Bisection for a predicate that is false at `lo` and true at `hi` (neither is evaluated).
/// Halves until hi − lo ≤ tolerance, or no number lies between:
///   ⌈log₂((hi − lo)/tolerance)⌉ evaluations.
/// @return a bracket with  isPast(lo) false, isPast(hi) true.
template <class Predicate>
Bracket bisect(Predicate&& isPast, double lo, double hi, double tolerance) {
  assert(lo <= hi && tolerance >= 0.0);
  while (hi - lo > tolerance) {
    const double middle = lo + 0.5 * (hi - lo);
    if (middle <= lo || middle >= hi) break;
    (isPast(middle) ? hi : lo) = middle;
  }
  return {lo, hi};
}

/// The ITP method for a continuous function whose values at the ends, `flo` and `fhi`, differ in
/// sign: the false position, moved a little towards the midpoint so that both ends close in, and
/// never so far from the midpoint that bisection would win by more than one evaluation.
///   Oliveira and Takahashi, An Enhancement of the Bisection Method Average Performance Preserving
///   Minmax Optimality, 2020, with κ₁ = 0.2/(hi − lo), κ₂ = 2, n₀ = 1. Departure: the move is at
///   least 0.4 tolerance, so that two evaluations beside a root already found close the bracket.
/// At most ⌈log₂((hi − lo)/tolerance)⌉ + 1 evaluations; 8 or 9 for a smooth simple root.
/// @return a bracket no wider than the tolerance, or than two neighbouring numbers: f(lo) has the
///   sign of `flo`, f(hi) does not (it may be zero).
template <class Function>
Bracket findRoot(Function&& f, double lo, double hi, double flo, double fhi, double tolerance) {
  assert(lo <= hi && tolerance > 0.0);
  const bool positive = flo > 0.0;
  const double kappa = 0.2 / (hi - lo);
  // How far from the midpoint one may go: what bisection with one evaluation more would forgive.
  double reach = tolerance;
  while (reach < hi - lo) reach *= 2.0;

  while (hi - lo > tolerance) {
    const double width = hi - lo, middle = lo + 0.5 * width;
    const double falsePosition = lo + width * (flo / (flo - fhi));
    const double side = middle > falsePosition ? 1.0 : -1.0;
    const double nudge = std::max(kappa * width * width, 0.4 * tolerance);
    double x = nudge <= std::abs(middle - falsePosition) ? falsePosition + side * nudge : middle;
    const double allowed = reach - 0.5 * width;
    if (!(std::abs(x - middle) <= allowed)) x = middle - side * allowed;
    if (!(x > lo && x < hi)) x = middle;
    if (x <= lo || x >= hi) break;

    const double fx = f(x);
    const bool first = positive ? fx > 0.0 : fx < 0.0;
    (first ? lo : hi) = x;
    (first ? flo : fhi) = fx;
    reach *= 0.5;
  }
  return {lo, hi};
}

}  // namespace tumble
