#include "sim/math/root.h"

#include <algorithm>
#include <cmath>

#include "tests/catch.h"

using namespace tumble;

// Oracle: closed form. Evaluations: log2(1/1e-12) = 39.9, so 40.
TEST_CASE("bisection brackets a change by its tolerance and halves once per evaluation") {
  int evaluations = 0;
  const auto isPast = [&](double t) {
    ++evaluations;
    return t * t > 0.3;
  };
  const Bracket b = bisect(isPast, 0.0, 1.0, 1e-12);
  CHECK(b.width() <= 1e-12);
  CHECK((b.lo * b.lo <= 0.3 && b.hi * b.hi > 0.3));
  CHECK(evaluations == 40);
}

TEST_CASE("bisection without a tolerance ends at two neighbouring numbers") {
  const Bracket b = bisect([](double t) { return t >= 1.0 / 3.0; }, 0.0, 1.0, 0.0);
  CHECK(b.hi == 1.0 / 3.0);
  CHECK(b.lo == std::nextafter(b.hi, 0.0));
}

namespace {

struct Case {
  const char* name;
  double (*f)(double);
  double lo, hi, root;
  double blur;      // how far rounding in f alone moves its change of sign
  int evaluations;  // measured
};

/// Runs findRoot on a case and counts.
Bracket solve(const Case& c, double tolerance, int& evaluations) {
  evaluations = 0;
  const auto counted = [&](double x) {
    ++evaluations;
    return c.f(x);
  };
  return findRoot(counted, c.lo, c.hi, c.f(c.lo), c.f(c.hi), tolerance);
}

}  // namespace

// Oracle: closed forms. What is cut off is what the allowance of a step looks like.
TEST_CASE("the root finder brackets each root, in a dozen evaluations if it is a simple one") {
  const Case c = GENERATE(
      Case{"falling 1 m", [](double t) { return 1.0 - 4.905 * t * t; }, 0.0, 1.0,
           0.45152364098573090, 1e-15, 4},
      Case{"exponential", [](double t) { return std::exp(t) - 2.0; }, 0.0, 1.0, 0.69314718055994531,
           1e-15, 8},
      Case{"cut off above a line", [](double t) { return std::min(0.5, 1e7 * (1e-3 - t)); }, 0.0,
           1.0, 1e-3, 1e-18, 4},
      Case{"cut off above a fall", [](double t) { return std::min(0.5, 1.0 - 1e12 * t * t); }, 0.0,
           1.0, 1e-6, 1e-18, 5},
      Case{"rising cubic", [](double t) { return t * t * t - 0.001; }, -1.0, 1.0, 0.1, 1e-15, 16},
      Case{"flat at its root", [](double t) { return (t - 0.3) * (t - 0.3) * (t - 0.3); }, 0.0, 1.0,
           0.3, 0.0, 72},
      Case{"a jump", [](double t) { return t < 0.7 ? -1e-9 : 1.0; }, 0.0, 1.0, 0.7, 0.0, 40});
  CAPTURE(c.name);
  int evaluations = 0;
  const Bracket b = solve(c, 1e-12, evaluations);
  CHECK(b.width() <= 1e-12);
  CHECK(c.f(b.lo) * c.f(c.lo) > 0.0);
  CHECK(c.f(b.hi) * c.f(c.lo) <= 0.0);
  CHECK((b.lo <= c.root + c.blur && b.hi >= c.root - c.blur));
  CHECK(evaluations <= 4 * static_cast<int>(std::ceil(std::log2((c.hi - c.lo) / 1e-12))));
  CHECK(evaluations <= c.evaluations);
}
