#include "sim/math/decay.h"

#include <cmath>

namespace tumble {
namespace {

/// e^{−r} for |r| ≤ ½ ln 2, by its series.
double shortDecay(double r) {
  double sum = 1.0;
  for (int k = 16; k > 0; --k) sum = 1.0 - r / k * sum;
  return sum;
}

/// Σ (−a)^k n!/(k + n)!: the mean is n! / n! of it for n = 1, the lag is half of it for n = 2.
double series(double a, int n) {
  double sum = 1.0;
  for (int k = 24; k > 0; --k) sum = 1.0 - a / (k + n) * sum;
  return sum;
}

}  // namespace

Decay decay(double a) {
  constexpr double kLn2High = 0x1.62e42fee00000p-1, kLn2Low = 0x1.a39ef35793c76p-33;
  constexpr double kNothing = 745.0;  // e^{−a} is below the least number
  constexpr double kSmall = 1.0;
  Decay d;
  const double halves = std::floor(a / (kLn2High + kLn2Low) + 0.5);
  const double r = (a - halves * kLn2High) - halves * kLn2Low;
  d.left = a > kNothing ? 0.0 : std::ldexp(shortDecay(r), -static_cast<int>(halves));
  if (a < kSmall) {
    d.mean = series(a, 1);
    d.lag = 0.5 * series(a, 2);
  } else {
    d.mean = (1.0 - d.left) / a;
    d.lag = (1.0 - d.mean) / a;
  }
  return d;
}

}  // namespace tumble
