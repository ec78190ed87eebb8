// Elliptic integrals and the exponential, against Boost.Math in extended precision.
#include "sim/math/elliptic.h"

#include <boost/math/special_functions/ellint_rf.hpp>
#include <cmath>
#include <limits>

#include "tests/catch.h"

using namespace tumble;
using Extended = long double;

namespace {

double relative(double value, const Extended& exact) {
  return static_cast<double>(std::abs((value - exact) / exact));
}

}  // namespace

// Oracle: extended precision. Measured 1.3e-16, allowed 2.2e-16.
TEST_CASE("the exponential is right to a unit in the last place") {
  double worst = 0.0;
  for (int n = -7000; n <= 7000; ++n) {
    const double x = 0.1 * n + 0.0123 * (n % 7);
    worst = std::max(worst, relative(exponential(x), std::exp(Extended(x))));
  }
  INFO("measured " << worst * 1e16 << "e-16");
  CHECK(worst < 2.2e-16);
  CHECK(exponential(0.0) == 1.0);
  CHECK(exponential(-800.0) == 0.0);
  CHECK(std::isinf(exponential(800.0)));
}

// Oracle: extended precision, K(k) = R_F(0, k′², 1). Measured 1.9e-16, allowed 5e-16.
TEST_CASE("the arithmetic-geometric mean gives the complete elliptic integral") {
  double worst = 0.0;
  for (double k1 = 1.0; k1 > 1e-12; k1 *= 0.07) {
    const Extended K = boost::math::ellint_rf(Extended(0), Extended(k1) * k1, Extended(1));
    worst =
        std::max(worst, relative(agm(1.0, k1), boost::math::constants::half_pi<Extended>() / K));
  }
  INFO("measured " << worst * 1e16 << "e-16");
  CHECK(worst < 5e-16);
  CHECK(agm(3.0, 0.0) == 0.0);
  CHECK(agm(2.0, 2.0) == 2.0);
}

// Oracle: extended precision, arguments far apart and one of them 0. Measured 4.2e-16, allowed
// 1e-15.
TEST_CASE("Carlson's integral of the first kind is right in all its arguments") {
  const double values[] = {0.0, 1e-34, 1e-17, 1e-6, 0.03, 0.4, 1.0, 7.0, 1e6};
  double worst = 0.0;
  for (const double x : values) {
    for (const double y : values) {
      for (const double z : values) {
        if ((x == 0.0) + (y == 0.0) + (z == 0.0) > 1) continue;
        const Extended exact = boost::math::ellint_rf(Extended(x), Extended(y), Extended(z));
        worst = std::max(worst, relative(carlsonRF(x, y, z), exact));
      }
    }
  }
  INFO("measured " << worst * 1e16 << "e-16");
  CHECK(worst < 1e-15);
  CHECK(worst > 0.0);
}

TEST_CASE("elliptic integrals of what is not a number, or has no end, end") {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  CHECK(std::isnan(agm(nan, 1.0)));
  CHECK(std::isnan(agm(1.0, infinity)));
  CHECK(agm(1.0, 0.0) == 0.0);
  CHECK(std::isnan(carlsonRF(nan, 1.0, 1.0)));
  CHECK(std::isnan(carlsonRF(infinity, 1.0, 1.0)));
  CHECK(carlsonRF(0.0, 0.0, 1.0) == infinity);
}
