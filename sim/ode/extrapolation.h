// Chapter 1, Y(t): steps of high order for smooth equations and tight tolerances.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/ode/system.h"

namespace tumble {

/// Gragg's midpoint rule with 2, 4, 6, 8 and 10 substeps, extrapolated in h² to none:
///   T(j,k) = T(j,k−1) + (T(j,k−1) − T(j−1,k−1)) / ((n_j/n_(j−k+1))² − 1)
/// Order 10; the last difference, of order 8, is the estimate of the error. A short step that fewer
/// substeps already bring to rounding ends with them. Hairer, Nørsett and
/// Wanner, Solving Ordinary Differential Equations I, §II.9. Departure: no smoothing step; what is
/// extrapolated is Y − Y(t), so that rounding stays that of the increment.
class Extrapolation {
 public:
  /// @param tolerance  error per step in each number y of Y, relative to 1 + |y|
  Extrapolation(int size, double tolerance);

  /// Replaces y = Y(t) by Y(t + h), h [s] of either sign, in as many steps as the tolerance asks
  /// for, and normalises it. The result depends on t, h and y alone.
  /// @return h [s], or how far a limited number of attempts led, which is where y then is
  double step(const System& system, double t, double h, std::span<double> y);

  /// One step alone: replaces y = Y(t) by what it is as far on as the tolerance lets go at once,
  /// and normalises nothing.
  /// @param most      [s] of either sign, no further than this
  /// @param size      [s] of the same sign: the step to try; afterwards that of the next
  /// @param attempts  that may still be made; counts down
  /// @return how far it led [s]; 0 where no attempts were left, or only rounding of t
  double stride(const System& system, double t, double most, double& size, int& attempts,
                std::span<double> y);

  /// Attempts in one step.
  static constexpr int kMostAttempts = 400;

 private:
  static constexpr int kColumns = 5;
  using Numbers = std::vector<double>;

  /// Y(t + h) − Y(t) into table_[column_], by as many columns as bring anything.
  /// @return the error relative to what is allowed
  double attempt(const System& system, double t, double h);
  /// The row of the tableau that begins with stage_. @return its last difference, as above
  double extend();
  /// The midpoint rule with n substeps into `increment`.
  void midpoint(const System& system, double t, double h, int n, Numbers& increment);

  std::size_t size_;
  double tolerance_;
  Numbers now_, rate_, first_, last_, stage_, slope_;
  std::array<Numbers, kColumns> table_;  ///< one diagonal
  int column_ = 0;
};

}  // namespace tumble
