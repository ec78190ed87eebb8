// Chapter 1, Y(t): how an adaptive integrator chooses its next step.
#pragma once

namespace tumble {

/// Fifth root of a positive finite number by Newton's iteration: the same bits everywhere.
double fifthRoot(double a);

/// Proportional-integral control of the step of a method whose error estimate is of fifth order
/// (Hairer and Wanner, Solving Ordinary Differential Equations II, §IV.2). Errors are relative to
/// the tolerance:
///   accepted  h' = h · 0.9 e⁻³ᐟ²⁰ e₀¹ᐟ²⁰   with e₀ the error of the step accepted before,
///   rejected  h' = h · 0.9 e⁻¹ᐟ⁵,
/// by no more than 5 times larger or 10 times smaller; not larger right after a rejection.
class StepControl {
 public:
  /// Factor for the next step after one whose error was accepted. error ≥ 0, finite.
  double afterAccepted(double error);
  /// Factor for the next attempt after one whose error was refused; it may be NaN or infinite.
  double afterRejected(double error);

 private:
  double lastError_ = 1.0;
  bool rejected_ = false;
};

}  // namespace tumble
