// Every row of the table of integrators against the exact rotor of an uneven body.
#include <cmath>
#include <vector>

#include "sim/body/body_system.h"
#include "sim/flight/flight.h"
#include "sim/ode/integrator.h"
#include "tests/body/bodies.h"
#include "tests/catch.h"

using namespace tumble;
using namespace tumble::test;

// Oracle: closed form of the rotor. Measured within 0.06 of the row's order, allowed ± 0.1.
TEST_CASE("the attitude of a tumbling brick converges with the order of each row", "[figures]") {
  const RigidBody start = tumblingBrick();
  const double end = 2.0;
  const Quat exact = Flight(start, Vec3::Zero(), 0.0).pose(end).q;
  const auto error = [&](const Integrator& row, int order, int steps) {
    const BodySystem system(Vec3::Zero(), {}, {start});
    std::vector<double> y(kStateSize);
    stateToArray(start, y);
    const auto stepper = row.make(kStateSize, {.order = order});
    for (int n = 0; n < steps; ++n) stepper->step(system, 0.0, end / steps, y);
    const Quat q(y[3], y[4], y[5], y[6]);
    return 2.0 * (exact.conjugate() * q).vec().norm();
  };
  const auto check = [&](const Integrator& row, int order, int steps) {
    const double coarse = error(row, order, steps), fine = error(row, order, 2 * steps);
    const double found = std::log2(coarse / fine);
    WARN("tumbling brick, " << row.name << ", " << 2 * steps << " steps: error " << fine
                            << " rad, order " << found << " of " << order);
    CHECK(found == Approx(order).margin(0.1));
  };
  // Without forces there is nothing to kick: symplectic Euler is its drift, of second order.
  const BodySystem system(Vec3::Zero(), {}, {start});
  for (const Integrator& row : integrators()) {
    if (row.adaptive || row.needs.split == Split::Rough || !suits(row, system)) continue;
    if (row.anyOrder)
      for (const auto& [order, steps] : {std::pair{3, 300}, {7, 40}}) check(row, order, steps);
    else
      check(row, row.order, row.order == 1 ? 12800 : row.order == 2 ? 800 : 200);
  }
}
