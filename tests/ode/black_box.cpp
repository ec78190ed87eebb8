// The black box of the course, as a student would use it.
#include <cmath>
#include <cstring>
#include <vector>

#include "sim/ode/integrator.h"
#include "sim/ode/ode.h"
#include "tests/catch.h"
#include "tests/ode/systems.h"

using namespace tumble;

namespace {

// A projectile, Y = (x, y, vx, vy), which uses its own copy of Y as scratch paper.
extern "C" void projectile(double /*t*/, double y[], double ydot[]) {
  ydot[0] = y[2];
  ydot[1] = y[3];
  ydot[2] = 0.0;
  ydot[3] = -9.81;
  y[0] = y[1] = y[2] = y[3] = NAN;
}

extern "C" void oscillator(double t, double y[], double ydot[]) {
  ydot[0] = y[1];
  ydot[1] = -y[0] + std::cos(2.0 * t);
}

}  // namespace

// Oracle: closed form, a parabola is integrated to rounding. Measured 4e-15, allowed 1e-12.
TEST_CASE("the black box throws a stone along its parabola") {
  double y0[4] = {0.0, 1.0, 3.0, 4.0}, yend[4];
  ode(y0, yend, 4, 0.0, 2.0, projectile);
  CHECK(yend[0] == Approx(6.0).epsilon(1e-12));
  CHECK(yend[1] == Approx(1.0 + 8.0 - 9.81 * 2.0).epsilon(1e-12));
  CHECK(yend[3] == Approx(4.0 - 9.81 * 2.0).epsilon(1e-12));
  CHECK((y0[0] == 0.0 && y0[1] == 1.0 && y0[2] == 3.0 && y0[3] == 4.0));
}

// Oracle: two ways to the same place, bit for bit.
TEST_CASE("a C callback and a C++ system give the same answer") {
  double y0[2] = {2.0 / 3.0, 0.5}, yend[2];
  ode(y0, yend, 2, 0.0, 7.0, oscillator);

  std::vector<double> y(y0, y0 + 2);
  findIntegrator("dopri5")->make(2)->step(test::DrivenOscillator(), 0.0, 7.0, y);
  CHECK(std::memcmp(yend, y.data(), sizeof yend) == 0);
  // Measured 4e-11, allowed 4e-10.
  CHECK(std::abs(y[0] - test::DrivenOscillator::exact(7.0)[0]) < 4e-10);
}

// Oracle: there and back. Measured 6e-11, allowed 6e-10.
TEST_CASE("the black box runs backwards, and in place") {
  double y[2] = {2.0 / 3.0, 0.5}, apart[2];
  ode(y, apart, 2, 0.0, 7.0, oscillator);
  ode(y, y, 2, 0.0, 7.0, oscillator);
  CHECK(std::memcmp(y, apart, sizeof y) == 0);
  ode(y, y, 2, 7.0, 0.0, oscillator);
  CHECK(std::abs(y[0] - 2.0 / 3.0) < 6e-10);
  CHECK(std::abs(y[1] - 0.5) < 6e-10);
}

TEST_CASE("the black box at one time changes nothing") {
  double y0[2] = {0.25, -4.0}, yend[2] = {};
  ode(y0, yend, 2, 3.0, 3.0, oscillator);
  CHECK(std::memcmp(y0, yend, sizeof y0) == 0);
}
