// Known solutions of tops at one time, to twenty digits, as marks for the table of integrators.
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/ode/integrator.h"
#include "tests/catch.h"
#include "tests/ode/systems.h"

using namespace tumble;
using namespace tumble::test;

namespace {

/// One problem: equations that hold piece by piece, and the solution at the end of the last.
struct Anchor {
  const char* name;
  std::vector<double> start;
  std::vector<std::pair<double, EulerEquations>> pieces;  ///< until when [s], which equations
  std::vector<double> end;
};

std::vector<Anchor> anchors() {
  const double pi = 3.14159265358979323846;
  const EulerEquations rest(-2.0, 1.25, -0.5), pushed(-2.0, 1.25, -0.5, 0.125);
  const EulerEquations hairer(-2.0, 1.25, -0.5), hairerPushed(-2.0, 1.25, -0.5, 0.125 / 3.0);
  return {
      // Krogh; Enright and Pryce, problem NB5: the elliptic functions (sn, cn, dn)(20 | 0.51).
      {"NB5",
       {0.0, 1.0, 1.0},
       {{20.0, EulerEquations(1.0, -1.0, -0.51)}},
       {-0.93965707987292039619, -0.34211777540007490653, 0.74141265961999530078}},
      // Hairer, Nørsett and Wanner, problem EULR: I = (½, 2, 3), pushed from 3π to 4π.
      {"EULR",
       {1.0, 0.0, 0.9},
       {{3.0 * pi, hairer}, {4.0 * pi, hairerPushed}, {20.0, hairer}},
       {-0.90117998372286005261, 0.34266842294817749467, 0.99551011690106641648}},
      // The rigid body of the SciML benchmarks: the same top, pushed all the time.
      {"SciML rigid body",
       {1.0, 0.0, 0.9},
       {{10.0, pushed}},
       {-0.66886242298013430157, -0.58769840220406839503, 2.01077739307361082123}},
  };
}

/// Largest error of the row in `steps` steps a second.
double errorOf(const Anchor& anchor, const Integrator& row, int steps, int order = 0) {
  std::vector<double> y = anchor.start;
  double t = 0.0;
  const auto stepper = row.make(3, {.order = order});
  for (const auto& [end, equations] : anchor.pieces) {
    const int n = static_cast<int>(std::ceil((end - t) * steps));
    const double h = (end - t) / n;
    for (int i = 0; i < n; ++i) stepper->step(equations, t + i * h, h, y);
    t = end;
  }
  double worst = 0.0;
  for (int i = 0; i < 3; ++i) worst = std::max(worst, std::abs(y[i] - anchor.end[i]));
  return worst;
}

}  // namespace

// Oracle: the solutions in thirty digits. Every row comes near with its order; a Taylor series of
// order 20 reaches what double precision holds. Measured 1.1e-14, 7e-15 and 4e-15, allowed 1e-13.
TEST_CASE("the table reaches the anchors, the Taylor series to 1e-13", "[figures]") {
  for (const Anchor& anchor : anchors()) {
    for (const Integrator& row : integrators()) {
      if (!suits(row, anchor.pieces[0].second)) continue;
      if (row.adaptive) {
        const double error = errorOf(anchor, row, 1);
        WARN(anchor.name << ", " << row.name << ": error " << error);
        CHECK(error < 1e-7);  // measured 3e-9 at worst, of tolerance 1e-10 a step
        continue;
      }
      if (row.anyOrder) {
        const double error = errorOf(anchor, row, 20, 20);
        WARN(anchor.name << ", " << row.name << " of order 20, 20 steps/s: error " << error);
        CHECK(error < 1e-13);
        continue;
      }
      const int steps = row.order == 1 ? 4000 : 100;
      const double coarse = errorOf(anchor, row, steps), fine = errorOf(anchor, row, 2 * steps);
      WARN(anchor.name << ", " << row.name << ", " << 2 * steps << " steps/s: error " << fine
                       << ", order " << std::log2(coarse / fine) << " of " << row.order);
      CHECK(std::log2(coarse / fine) == Approx(row.order).margin(0.1));
    }
  }
}
