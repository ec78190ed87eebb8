// Sines and cosines against those of the library in extended precision.
#include <cmath>
#include <cstdint>

#include "sim/math/rotation.h"
#include "tests/catch.h"

using namespace tumble;
using Extended = long double;

namespace {

/// Distance of a double from the true value, in units of the last place of the double.
double ulps(double got, Extended exact) {
  const double size = std::abs(got), ulp = std::nextafter(size, 2.0) - size;
  return static_cast<double>(std::abs((got - exact) / ulp));
}

double worstError(double x) {
  double s, c;
  sinCos(x, s, c);
  return std::max(ulps(s, std::sin(Extended(x))), ulps(c, std::cos(Extended(x))));
}

}  // namespace

// Oracle: extended precision. Measured 0.74, allowed 1.
TEST_CASE("sine and cosine are right to one unit in the last place, up to a hundred thousand") {
  double worst = 0.0;
  std::uint64_t seed = 1;
  for (int i = 0; i < 20000; ++i) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    const double unit = static_cast<double>(seed >> 11) * 0x1p-53;
    // As many angles between 1e-3 and 1e-2 as between 1e4 and 1e5.
    const double x = std::pow(10.0, -3.0 + 8.0 * unit) * ((seed & 1024) ? 1.0 : -1.0);
    worst = std::max(worst, worstError(x));
  }
  INFO("worst error in units of the last place: " << worst);
  CHECK(worst <= 1.0);
}

// Oracle: extended precision. Here sine or cosine all but vanish, and only the low parts of π/2
// are left of the angle. Measured 0.50, allowed 1.
TEST_CASE("sine and cosine keep all their digits next to multiples of a right angle") {
  double worst = 0.0;
  for (int k = 1; k < 65000; k += 13) {
    const double near = k * 1.5707963267948966;
    worst = std::max({worst, worstError(near), worstError(-std::nextafter(near, 1e9))});
  }
  INFO("worst error in units of the last place: " << worst);
  CHECK(worst <= 1.0);
}

TEST_CASE("sine is odd, cosine even, bit for bit, and both are exact at zero") {
  double s, c, sMinus, cMinus;
  sinCos(0.0, s, c);
  CHECK((s == 0.0 && c == 1.0));
  for (const double x : {1e-300, 0.3, 0.8, 2.0, 4.0, 5.5, 1234.5}) {
    sinCos(x, s, c);
    sinCos(-x, sMinus, cMinus);
    CHECK((sMinus == -s && cMinus == c));
  }
}

TEST_CASE("an angle that cannot be reduced gives NaN rather than a wrong sine") {
  double s, c;
  for (const double x : {3e8, -1e300, std::nan(""), static_cast<double>(INFINITY)}) {
    sinCos(x, s, c);
    CHECK((std::isnan(s) && std::isnan(c)));
  }
}
