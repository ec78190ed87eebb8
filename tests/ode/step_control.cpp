#include "sim/ode/step_control.h"

#include <cmath>

#include "tests/catch.h"

using namespace tumble;

// Oracle: closed form. Measured 2e-16 relative, allowed 1e-15.
TEST_CASE("the fifth root is right at every size") {
  for (double a = 1e-300; a < 1e300; a *= 7.3e3) {
    const double exact = static_cast<double>(std::pow(static_cast<long double>(a), 0.2L));
    CAPTURE(a);
    CHECK(fifthRoot(a) == Approx(exact).epsilon(1e-15).margin(0.0));
  }
  CHECK(fifthRoot(32.0) == Approx(2.0).epsilon(1e-15));
}

TEST_CASE("a step whose error was 32 times too large is cut to less than a half") {
  StepControl control;
  CHECK(control.afterRejected(32.0) == Approx(0.45));
  CHECK(control.afterRejected(NAN) == Approx(0.1));
  CHECK(control.afterRejected(1e30) == Approx(0.1));
}

TEST_CASE(
    "a step grows with a small error, but not right after a rejection, and at most fivefold") {
  StepControl control;
  CHECK(control.afterAccepted(1.0) == Approx(0.9));
  CHECK(control.afterAccepted(1e-4) == Approx(0.9 * std::pow(10.0, 0.6)));
  CHECK(control.afterAccepted(1e-4) == Approx(0.9 * std::pow(10.0, 0.4)));
  CHECK(control.afterAccepted(0.0) == 5.0);
  control.afterRejected(2.0);
  CHECK(control.afterAccepted(1e-4) == 1.0);
  CHECK(control.afterAccepted(1e-4) > 1.0);
}
