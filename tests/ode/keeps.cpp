// What each row of the table of integrators says it keeps, it keeps; what it does not say, it does
// not.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/ode/integrator.h"
#include "tests/catch.h"
#include "tests/ode/systems.h"

using namespace tumble;
using namespace tumble::test;

namespace {

/// One step of the pendulum; a row of any order takes 4 here, so that its error is seen.
std::array<double, 2> swing(const Integrator& row, double h, std::array<double, 2> y) {
  row.make(2, {.order = 4})->step(Pendulum(), 0.0, h, y);
  return y;
}

}  // namespace

// Oracle: conservation of y₁² + y₂² and 0.51 y₁² + y₃², of the free top of Krogh's problem NB5.
// The line is 1e-13; the rows that do not keep them miss by 3e-10 (dopri5), 3e-6 (rk4) and more.
TEST_CASE("the rows that keep quadratic invariants keep energy and momentum of a free top") {
  const EulerEquations top(1.0, -1.0, -0.51);
  for (const Integrator& row : integrators()) {
    if (!suits(row, top)) continue;
    std::vector<double> y = {0.0, 1.0, 1.0};
    run(row, top, 100.0, row.adaptive ? 10 : 1000, y, 4);
    const double momentum = std::abs(y[0] * y[0] + y[1] * y[1] - 1.0);
    const double energy = std::abs(0.51 * y[0] * y[0] + y[2] * y[2] - 1.0);
    CAPTURE(row.name, momentum, energy);
    CHECK((std::max(momentum, energy) < 1e-13) == row.keeps.quadratic);
  }
}

// Oracle: invariant. The area of a small square of starts, by central differences of 1e-5. The
// line is 1e-8; rows that are not symplectic miss by 8e-6 (rk4) and more. (The adaptive row is
// accurate beyond that.)
TEST_CASE("the symplectic rows keep areas in the phase space of a pendulum") {
  const double h = 0.4, d = 1e-5;
  const std::array<double, 2> y = {1.2, 0.7};
  for (const Integrator& row : integrators()) {
    if (row.adaptive) continue;
    const auto right = swing(row, h, {y[0] + d, y[1]}), left = swing(row, h, {y[0] - d, y[1]});
    const auto up = swing(row, h, {y[0], y[1] + d}), down = swing(row, h, {y[0], y[1] - d});
    const double area =
        ((right[0] - left[0]) * (up[1] - down[1]) - (up[0] - down[0]) * (right[1] - left[1])) /
        (4.0 * d * d);
    CAPTURE(row.name, area - 1.0);
    CHECK((std::abs(area - 1.0) < 1e-8) == row.keeps.symplectic);
  }
}

// Oracle: there and back. The line is 1e-14; fixed-step rows that are not symmetric miss by 1e-5
// and more.
TEST_CASE("a step back of a symmetric row undoes the step there") {
  const std::array<double, 2> start = {1.2, 0.7};
  for (const Integrator& row : integrators()) {
    const auto back = swing(row, -0.4, swing(row, 0.4, start));
    const double miss = std::hypot(back[0] - start[0], back[1] - start[1]);
    CAPTURE(row.name, miss);
    CHECK((miss < 1e-14) == row.keeps.symmetric);
  }
}

// Oracle: conservation. The energy error of symplectic rows over 20,000 steps of a swinging
// pendulum is no larger in the last tenth than in the first; that of other fixed-step rows has
// grown.
TEST_CASE("the energy of a symplectic row only oscillates") {
  const Pendulum pendulum;
  const auto energy = [](std::span<const double> y) { return 0.5 * y[1] * y[1] - std::cos(y[0]); };
  for (const Integrator& row : integrators()) {
    if (row.adaptive) continue;
    std::vector<double> y = {1.2, 0.0};
    const double start = energy(y);
    const auto stepper = row.make(2, {.order = 4});
    double early = 0.0, late = 0.0;
    for (int n = 0; n < 20000; ++n) {
      stepper->step(pendulum, 0.0, 0.2, y);
      if (n < 2000) early = std::max(early, std::abs(energy(y) - start));
      if (n >= 18000) late = std::max(late, std::abs(energy(y) - start));
    }
    CAPTURE(row.name, early, late);
    CHECK((late < 1.1 * early) == row.keeps.symplectic);
  }
}

TEST_CASE("what a system lacks for a row is said in words") {
  CHECK(missing({}, {}).empty());
  CHECK(missing({}, {.jet = true}) == "a Taylor jet");
  CHECK(missing({.jet = true}, {.lie = true}) == "an action of a Lie group");
  CHECK(missing({.split = Split::Rough}, {.split = Split::Rough}).empty());
  CHECK(missing({.split = Split::Rough}, {.split = Split::Symmetric}) ==
        "a kick and a drift that can be undone");
  CHECK(missing({.split = Split::Symmetric}, {.split = Split::Exact}) ==
        "a kick and a drift that are exact");
}
