// Sums and products of pairs of doubles, against whole numbers. tests/oracle holds them to 50
// digits.
#include "sim/math/double_double.h"

#include "tests/catch.h"

using namespace tumble;

// Oracle: closed form, (2²⁷ + 1)² = 2⁵⁴ + 2²⁸ + 1.
TEST_CASE("a pair of doubles keeps what its first leaves of a sum and of a product") {
  const double a = 0x1p27 + 1.0;
  const DoubleDouble square = twoProduct(a, a), sum = twoSum(1.0, 0x1p-70);
  CHECK((square.hi == 0x1p54 + 0x1p28 && square.lo == 1.0));
  CHECK((sum.hi == 1.0 && sum.lo == 0x1p-70));
  const DoubleDouble difference = square - twoProduct(0x1p27, 0x1p27 + 2.0);
  CHECK((difference.hi == 1.0 && difference.lo == 0.0));
  const DoubleDouble root = square / DoubleDouble{a, 0.0};
  CHECK((root.hi == a && root.lo == 0.0));
}

TEST_CASE("pairs of doubles are in the order of their sums") {
  const DoubleDouble a{1.0, 1e-20}, b{1.0, 2e-20};
  CHECK(a < b);
  CHECK_FALSE(b < a);
  CHECK_FALSE(a < a);
  CHECK(-b < a);
}
