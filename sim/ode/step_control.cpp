#include "sim/ode/step_control.h"

#include <algorithm>
#include <cmath>

namespace tumble {
namespace {
constexpr double kSafety = 0.9, kShrink = 0.1, kGrow = 5.0;
constexpr double kLeastError = 1e-10;  // below it the factor is at its bound anyway
}  // namespace

double fifthRoot(double a) {
  // a = m 2^(5k) with m in [1/32, 1), whose root lies in [1/2, 1).
  int exponent = 0;
  double m = std::frexp(a, &exponent);
  const int k = exponent > 0 ? (exponent + 4) / 5 : exponent / 5;
  m = std::ldexp(m, exponent - 5 * k);
  double x = 1.0;
  for (int i = 0; i < 12; ++i) x -= (x - m / (x * x * x * x)) / 5.0;
  return std::ldexp(x, k);
}

double StepControl::afterAccepted(double error) {
  const double e = std::max(error, kLeastError);
  const double root = std::sqrt(std::sqrt(fifthRoot(lastError_ / (e * e * e))));
  const double factor = std::clamp(kSafety * root, kShrink, rejected_ ? 1.0 : kGrow);
  lastError_ = e;
  rejected_ = false;
  return factor;
}

double StepControl::afterRejected(double error) {
  rejected_ = true;
  if (!std::isfinite(error)) return kShrink;
  return std::clamp(kSafety / fifthRoot(error), kShrink, 1.0);
}

}  // namespace tumble
