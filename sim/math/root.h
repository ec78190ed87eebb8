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

/// The last three points at which a function was on one side of zero.
class OneSide {
 public:
  OneSide(double at, double value) { add(at, value); }
  void add(double at, double value) {
    oldest_ = before_;
    before_ = last_;
    last_ = {at, value};
  }
  double end() const { return last_.at; }
  double value() const { return last_.value; }
  /// Where the parabola through them is zero, or the line through two, as seen from the last; no
  /// number where that says nothing.
  double root() const {
    const double slope = slopeOf(last_, before_);
    double step = -last_.value / slope;
    const double bend = (slope - slopeOf(before_, oldest_)) / (last_.at - oldest_.at);
    const double rate = slope + bend * (last_.at - before_.at);
    const double square = rate * rate - 4.0 * bend * last_.value;
    if (square >= 0.0) step = -2.0 * last_.value / (rate + std::copysign(std::sqrt(square), rate));
    return last_.at + step;
  }

 private:
  struct Point {
    double at = std::numeric_limits<double>::quiet_NaN(), value = at;
  };
  static double slopeOf(const Point& p, const Point& q) {
    return (p.value - q.value) / (p.at - q.at);
  }
  Point last_, before_, oldest_;
};

/// Looks for the root of a continuous function whose values at the ends, `flo` and `fhi`, differ in
/// sign, where the last three points of one side would have it, and else in the middle: where
/// neither side points into the bracket, and where three points in a row have neither halved it nor
/// brought the value down to a quarter. So a function that is cut off on one side, or jumps, costs
/// hardly more than a smooth one. A point beside a root that has been found goes past it.
/// 4 to 16 evaluations for a simple root, as many as bisection for a jump, up to twice as many for
/// a root of higher order; what falls to a quarter again and again, and never changes sign, has no
/// bound of its own.
/// @return a bracket no wider than the tolerance, or than two neighbouring numbers: f(lo) has the
///   sign of `flo`, f(hi) has not; or a point of a value no larger than `close`, as both ends.
template <class Function>
Bracket findRoot(Function&& f, double lo, double hi, double flo, double fhi, double tolerance,
                 double close = -1.0) {
  assert(lo <= hi && tolerance > 0.0);
  constexpr int kSlow = 3;         // points
  constexpr double kFalls = 0.25;  // of the value before
  constexpr double kPast = 0.9;    // of the tolerance
  OneSide below(lo, flo), above(hi, fhi);
  OneSide *last = &below, *other = &above;
  const auto width = [&] { return above.end() - below.end(); };
  double halved = width();
  for (int slow = 0; width() > tolerance;) {
    const double least = std::min(kPast * tolerance, 0.5 * width());
    const auto isWithin = [&](double x) { return x >= below.end() && x <= above.end(); };
    double x = last->root();
    if (!isWithin(x)) {
      x = other->root();
      if (std::abs(x - last->end()) < least) x = lo - width();  // where it has just been looked for
    }
    if (!isWithin(x) || slow >= kSlow) {
      x = below.end() + 0.5 * width();
      slow = 0;
    }
    x = std::clamp(x, below.end() + least, above.end() - least);
    if (x == below.end()) x = std::nextafter(x, hi);
    if (x == above.end()) x = std::nextafter(x, lo);
    if (x == below.end()) break;

    const double value = f(x);
    if (std::abs(value) <= close) return {x, x};
    const bool isBelow = flo > 0.0 ? value > 0.0 : value < 0.0;
    last = isBelow ? &below : &above;
    other = isBelow ? &above : &below;
    slow = std::abs(value) <= kFalls * std::abs(last->value()) ? 0 : slow + 1;
    last->add(x, value);
    if (width() <= 0.5 * halved) {
      halved = width();
      slow = 0;
    }
  }
  return {below.end(), above.end()};
}

}  // namespace tumble
