#include "sim/math/elliptic.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tumble {

double exponential(double x) {
  if (x > 709.0) return std::numeric_limits<double>::infinity();
  if (x < -708.0) return 0.0;

  // x = k ln 2 + r, |r| ≤ ½ ln 2, with ln 2 in two parts; a multiple k of the first is exact.
  constexpr double kLn2Hi = 0x1.62e42feep-1, kLn2Lo = 0x1.a39ef35793c76p-33;
  const double k = std::floor(x * 0x1.71547652b82fep+0 + 0.5);
  const double hi = x - k * kLn2Hi, lo = -k * kLn2Lo;
  const double r = hi + lo, rest = (hi - r) + lo;

  // e^r − 1 − r by Taylor's series to r¹³; what is cut off is below 5e-18.
  double p = 1.0 / 6227020800.0;
  p = p * r + 1.0 / 479001600.0;
  p = p * r + 1.0 / 39916800.0;
  p = p * r + 1.0 / 3628800.0;
  p = p * r + 1.0 / 362880.0;
  p = p * r + 1.0 / 40320.0;
  p = p * r + 1.0 / 5040.0;
  p = p * r + 1.0 / 720.0;
  p = p * r + 1.0 / 120.0;
  p = p * r + 1.0 / 24.0;
  p = p * r + 1.0 / 6.0;
  p = p * r + 0.5;
  const double head = 1.0 + (r + (r * r * p + rest));

  // 2^k as the exponent of a double.
  const auto exponent = static_cast<std::uint64_t>(static_cast<std::int64_t>(k) + 1022);
  return head * std::bit_cast<double>(exponent << 52) * 2.0;
}

double agm(double a, double b) {
  if (!std::isfinite(a + b)) return std::numeric_limits<double>::quiet_NaN();
  if (!(a > 0.0 && b > 0.0)) return 0.0;
  constexpr double kNear = 1e-8;  // the square of it is rounding
  // The mean of two numbers that differ by δ is off by δ²/16.
  while (std::abs(a - b) > kNear * a) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return 0.5 * (a + b);
}

double carlsonRF(double x, double y, double z) {
  if (!std::isfinite(x + y + z)) return std::numeric_limits<double>::quiet_NaN();
  if (!(x + y > 0.0 && y + z > 0.0 && z + x > 0.0)) return std::numeric_limits<double>::infinity();
  for (;;) {
    const double mean = (x + y + z) / 3.0;
    const double X = 1.0 - x / mean, Y = 1.0 - y / mean, Z = -(X + Y);
    if (std::max({std::abs(X), std::abs(Y), std::abs(Z)}) < 0.01) {
      // What is cut off is of order 8: below 1e-17.
      const double E2 = X * Y - Z * Z, E3 = X * Y * Z;
      const double series = E2 * (-1.0 / 10.0 + E2 * (1.0 / 24.0 - E2 * (5.0 / 208.0))) +
                            E3 * (1.0 / 14.0 + E3 * (3.0 / 104.0)) +
                            E2 * E3 * (-3.0 / 44.0 + E2 / 16.0);
      return (1.0 + series) / std::sqrt(mean);
    }
    // A duplication takes each to a quarter of its distance from the mean.
    const double rx = std::sqrt(x), ry = std::sqrt(y), rz = std::sqrt(z);
    const double lambda = rx * ry + rx * rz + ry * rz;
    x = 0.25 * (x + lambda), y = 0.25 * (y + lambda), z = 0.25 * (z + lambda);
  }
}

}  // namespace tumble
