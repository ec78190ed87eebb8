// Exponential decay against the library's, which is right to a unit in the last place.
#include "tests/catch.h"

#include <cmath>

#include "sim/math/decay.h"

using namespace tumble;

// Oracle: std::exp and std::expm1 in extended precision. Measured 3e-16, allowed 1e-15.
TEST_CASE("what decays is left, has a mean and a lag as the exponential says") {
  for (int i = -400; i <= 90; ++i) {
    const long double a = std::pow(10.0L, i / 40.0L);
    const Decay d = decay(static_cast<double>(a));
    const auto exactly = static_cast<long double>(static_cast<double>(a));
    const long double left = std::exp(-exactly), mean = -std::expm1(-exactly) / exactly;
    INFO("a = " << static_cast<double>(a));
    if (left > 1e-300L) CHECK(std::abs(static_cast<double>(d.left / left - 1.0L)) < 1e-15);
    CHECK(std::abs(static_cast<double>(d.mean / mean - 1.0L)) < 1e-15);
    if (a > 1e-3L)
      CHECK(std::abs(static_cast<double>(d.lag * exactly / (1.0L - mean) - 1.0L)) < 1e-15);
  }
  CHECK(decay(0.0).left == 1.0);
  CHECK(decay(0.0).mean == 1.0);
  CHECK(decay(0.0).lag == 0.5);
  CHECK(decay(1e300).left == 0.0);
}
