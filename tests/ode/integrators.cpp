// Every row of the table of integrators, held to equations with known solutions.
#include "sim/ode/integrator.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "tests/catch.h"
#include "tests/ode/systems.h"

using namespace tumble;
using namespace tumble::test;

namespace {

double distance(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

/// Exponent p of error ~ h^p between `steps` and twice as many.
template <class Error>
double observedOrder(Error error, int steps) {
  return std::log2(error(steps) / error(2 * steps));
}

}  // namespace

TEST_CASE("the table has a row for each name and none for a stranger") {
  for (const char* name :
       {"euler", "symplectic-euler", "midpoint", "implicit-midpoint", "splitting2", "rk4", "rkmk4",
        "splitting4", "nystrom4", "taylor", "dopri5", "extrapolation"}) {
    REQUIRE(findIntegrator(name) != nullptr);
    CHECK(findIntegrator(name)->name == name);
  }
  CHECK(findIntegrator("Euler") == nullptr);
  for (const Integrator& row : integrators()) CHECK(findIntegrator(row.name) == &row);
}

// Oracle: order of convergence on a driven oscillator, whose driving force also tests the times at
// which stages look. Measured within 0.03 of the row's order; allowed ± 0.1.
TEST_CASE("the error of each fixed-step integrator falls with the order its row claims",
          "[figures]") {
  const DrivenOscillator system;
  const auto check = [&](const Integrator& row, int order, int steps) {
    const auto error = [&](int n) {
      std::vector<double> y = {2.0 / 3.0, 0.5};
      run(row, system, 3.0, n, y, order);
      return distance(y, DrivenOscillator::exact(3.0));
    };
    const double coarse = error(steps), fine = error(2 * steps), found = std::log2(coarse / fine);
    WARN("driven oscillator, " << row.name << ", " << 2 * steps << " steps: error " << fine
                               << ", order " << found << " of " << order);
    CHECK(found == Approx(order).margin(0.1));
  };
  for (const Integrator& row : integrators()) {
    REQUIRE(suits(row, system));
    if (row.anyOrder) {
      for (const auto& [order, steps] : {std::pair{2, 400}, {5, 60}, {8, 16}})
        check(row, order, steps);
    } else if (!row.adaptive) {
      check(row, row.order, row.order >= 4 ? 100 : 400);
    }
  }
}

// Oracle: order of convergence to the closed form of an equation that is not linear. (Not over a
// whole turn, where the errors of some symplectic methods cancel.) Measured within 0.06 of the
// row's order; allowed ± 0.1.
TEST_CASE("the orders hold for a nonlinear equation", "[figures]") {
  const Kepler system;
  const double end = 2.5;
  for (const Integrator& row : integrators()) {
    if (row.adaptive || !suits(row, system)) continue;
    const auto error = [&](int steps) {
      std::vector<double> y = Kepler::start();
      run(row, system, end, steps, y);
      return distance(y, Kepler::exact(end));
    };
    const int steps = row.order == 4 ? 500 : row.order == 2 ? 4000 : 40000;
    const double coarse = error(steps), fine = error(2 * steps), found = std::log2(coarse / fine);
    WARN("Kepler ellipse, " << row.name << ", " << 2 * steps << " steps: error " << fine
                            << ", order " << found << " of " << row.order);
    CHECK(found == Approx(row.order).margin(0.1));
  }
}

// Oracle: closed form. Its local tolerance of 1e-10 grows by the conditioning of the orbit.
// Measured 1.1e-8 after one turn in 1382 evaluations; a wrong weight would need far more.
TEST_CASE("the adaptive integrator holds its tolerance at the cost of its order") {
  const Integrator& row = *findIntegrator("dopri5");
  const Kepler system;
  std::vector<double> y = Kepler::start();
  run(row, system, 2.0 * 3.14159265358979323846, 1, y);
  CAPTURE(system.evaluations, distance(y, Kepler::start()));
  CHECK(distance(y, Kepler::start()) < 5e-8);
  CHECK(system.evaluations < 1500);
}

// Oracle: closed form, as above. Measured 4e-10 after one turn in 833 evaluations, either way in
// time.
TEST_CASE("extrapolation comes as near in fewer looks") {
  const Integrator& row = *findIntegrator("extrapolation");
  const double turn = 2.0 * 3.14159265358979323846 * GENERATE(1.0, -1.0);
  const Kepler system;
  std::vector<double> y = Kepler::start();
  run(row, system, turn, 1, y);
  CAPTURE(system.evaluations, distance(y, Kepler::start()));
  CHECK(distance(y, Kepler::start()) < 3e-8);
  CHECK(system.evaluations < 1050);
}

// Oracle: closed form. Powers up to t⁴ are integrated to rounding, the estimate being zero too only
// up to t³. Measured 1e-15 and 6e-17, allowed 1e-14.
TEST_CASE("the adaptive integrator takes a polynomial of its order in one look") {
  const auto quartic = [](double t, std::span<const double>, std::span<double> ydot) {
    ydot[0] = 5.0 * t * t * t * t;
    ydot[1] = 4.0 * t * t * t;
  };
  const Given system(2, quartic);
  std::vector<double> y = {0.0, 0.0};
  run(*findIntegrator("dopri5"), system, 1.5, 1, y);
  CHECK(std::abs(y[0] - std::pow(1.5, 5)) < 1e-14);
  CHECK(std::abs(y[1] - std::pow(1.5, 4)) < 1e-14);
}

// Oracle: closed form. Measured 7e-12 with the order of the row over a step of 0.4, allowed 5e-11.
TEST_CASE("a Taylor step is its own dense output") {
  const DrivenOscillator system;
  const auto stepper = findIntegrator("taylor")->make(2);
  const double h = GENERATE(0.4, -0.4);
  std::vector<double> y = {2.0 / 3.0, 0.5}, between(2);
  stepper->step(system, 0.0, h, y);
  double worst = 0.0;
  for (int i = 0; i <= 100; ++i) {
    REQUIRE(stepper->dense(h * i / 100.0, between));
    worst = std::max(worst, distance(between, DrivenOscillator::exact(h * i / 100.0)));
  }
  CAPTURE(worst);
  CHECK(worst < 5e-11);
  CHECK(distance(between, y) == 0.0);
  CHECK_FALSE(stepper->dense(1.001 * h, between));
  CHECK_FALSE(stepper->dense(-0.001 * h, between));
}

// Oracle: closed form; substeps obey 1e-10 and interpolate to the same order of size.
// Measured 1.7e-10 over the whole step, allowed 1e-9; ends to rounding.
TEST_CASE("dense output follows the solution all through the last step, either way in time") {
  const DrivenOscillator system;
  const auto stepper = findIntegrator("dopri5")->make(2);
  const double t0 = 1.0, h = GENERATE(2.0, -2.0);
  const auto begin = DrivenOscillator::exact(t0);
  std::vector<double> y(begin.begin(), begin.end()), between(2);
  stepper->step(system, t0, h, y);

  double worst = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const double t = i == 1000 ? t0 + h : t0 + h * i / 1000.0;
    REQUIRE(stepper->dense(t, between));
    worst = std::max(worst, distance(between, DrivenOscillator::exact(t)));
  }
  CAPTURE(worst);
  CHECK(worst < 1e-9);
  CHECK((stepper->dense(t0, between) && distance(between, begin) == 0.0));
  CHECK((stepper->dense(t0 + h, between) && distance(between, y) < 1e-15));  // rounding
  CHECK_FALSE(stepper->dense(t0 + 1.001 * h, between));
  CHECK_FALSE(stepper->dense(t0 - 0.001 * h, between));
}

// Oracle: bit-equal rerun.
TEST_CASE("a step depends on its own start alone, not on the steps before") {
  const Kepler system;
  for (const Integrator& row : integrators()) {
    if (!suits(row, system)) continue;
    const auto fresh = row.make(4), used = row.make(4);
    std::vector<double> a = Kepler::start(), b = {0.1, 0.2, 1.0, 3.0};
    used->step(system, 0.0, 0.5, b);
    b = a;
    fresh->step(system, 0.0, 0.1, a);
    used->step(system, 0.0, 0.1, b);
    CAPTURE(row.name);
    CHECK(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
  }
}

// Oracle: conservation. After 100 turns symplectic Euler has lost 2.1e-4 of the energy of 0.5,
// while Euler, with the same step, has gained 0.38.
TEST_CASE("symplectic Euler keeps the energy of an orbit in bounds, explicit Euler lets it grow") {
  const Kepler system;
  const auto drift = [&](const char* name) {
    std::vector<double> y = Kepler::start();
    run(*findIntegrator(name), system, 200.0 * 3.14159265358979323846, 600000, y);
    return std::abs(Kepler::energy(y) - Kepler::energy(Kepler::start()));
  };
  const double symplectic = drift("symplectic-euler"), euler = drift("euler");
  CAPTURE(symplectic, euler);
  CHECK(symplectic < 1e-3);
  CHECK(euler > 0.2);
}
