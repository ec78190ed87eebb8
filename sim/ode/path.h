// Chapter 1, Y(t): a solution that is looked at again and again.
#pragma once

#include <span>
#include <vector>

#include "sim/ode/extrapolation.h"

namespace tumble {

/// Y(t0 + s) for 0 ≤ s ≤ reached(), kept at the ends of the steps that the tolerance asks for,
/// where it is normalised. Any instant between two of them is one step away from the first, so that
/// an event on a long or stiff path costs no more than on a short one.
class Path {
 public:
  /// @param first  [s] the step to try first
  void begin(double t0, double first, std::span<const double> y);
  /// Goes on by one step, no further than `most`. @return false if no attempts are left
  bool grow(const System& system, Extrapolation& integrator, double most);
  /// Back to where at(s) is the end, from where the next step is tried at `size`.
  void cut(double s, double size);
  /// y = Y(t0 + s), 0 ≤ s ≤ reached(), normalised but for s = 0.
  void at(const System& system, Extrapolation& integrator, double s, std::span<double> y) const;
  double reached() const { return ends_.back(); }

 private:
  double t0_ = 0.0, size_ = 0.0;  ///< [s]
  int attempts_ = 0;
  std::vector<double> ends_;    ///< [s] from t0, rising
  std::vector<double> values_;  ///< Y at each of them, one after the other
};

}  // namespace tumble
