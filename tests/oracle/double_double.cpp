// Sums and products of pairs of doubles, against 50 digits.
#include "sim/math/double_double.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "tests/catch.h"

using namespace tumble;
using FiftyDigits = boost::multiprecision::cpp_bin_float_50;

namespace {

FiftyDigits exact(const DoubleDouble& a) {
  return FiftyDigits(a.hi) + a.lo;
}

}  // namespace

// Oracle: 50 digits. A pair holds any sum or product of two doubles.
TEST_CASE("a sum and a product of two doubles have no rounding error") {
  for (const double a : {1.0 / 3.0, -7.1e8, 3e-20}) {
    for (const double b : {0.1, 123456789.123, -1.0 / 3.0}) {
      CHECK(exact(twoSum(a, b)) == FiftyDigits(a) + b);
      CHECK(exact(twoProduct(a, b)) == FiftyDigits(a) * b);
    }
  }
}

// Oracle: 50 digits. Measured 1e-32, allowed 1e-31 of the terms.
TEST_CASE("pairs of doubles carry thirty digits") {
  const DoubleDouble a = twoProduct(1.0 / 3.0, 0.1), b = twoProduct(-0.7, 1.0 / 21.0);
  const auto near = [](const DoubleDouble& got, const FiftyDigits& want) {
    return abs(exact(got) - want) < FiftyDigits(1e-31);
  };
  CHECK(near(a + b, exact(a) + exact(b)));
  CHECK(near(a - b, exact(a) - exact(b)));
  CHECK(near(a * b, exact(a) * exact(b)));
  CHECK(near(3.0 * b, 3 * exact(b)));
  CHECK(near(a / b, exact(a) / exact(b)));
  CHECK(near(DoubleDouble{1.0, 0.0} / a * a, 1));
  // All but the last digits cancel.
  CHECK(exact(a - a) == 0);
  CHECK_FALSE(near(a + b, FiftyDigits(a.hi + b.hi)));
}
