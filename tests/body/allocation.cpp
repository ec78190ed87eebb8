// A step allocates nothing once warm.
#include <vector>

#include "sim/body/body_system.h"
#include "sim/ode/integrator.h"
#include "tests/allocations.h"
#include "tests/body/bodies.h"
#include "tests/catch.h"

using namespace tumble;
using namespace tumble::test;

TEST_CASE("no integrator allocates in a step once warm") {
  const Force calm = Spring{0, 1, Vec3::Zero(), Vec3::Zero(), 10.0, 0.0, 0.5};
  const Force damped = Spring{0, 1, Vec3::Zero(), Vec3::Zero(), 10.0, 1.0, 0.5};
  const Vec3 gravity(0.0, -9.81, 0.0);
  const BodySystem dragged(gravity, {damped, LinearDrag{}}, {tumblingBrick(), tumblingCylinder()});
  const BodySystem tumbling(gravity, {calm}, {tumblingBrick(), tumblingCylinder()});
  const BodySystem even(gravity, {calm}, {tumblingCylinder(), tumblingCylinder()});
  for (const Integrator& row : integrators()) {
    REQUIRE(suits(row, even));
    const BodySystem& system = suits(row, dragged)    ? dragged
                               : suits(row, tumbling) ? tumbling
                                                      : even;
    std::vector<double> y(system.size());
    const auto stepper = row.make(system.size());
    system.toArray(y);
    stepper->step(system, 0.0, 0.1, y);
    system.toArray(y);
    const long before = test::allocations;
    stepper->step(system, 0.0, 0.1, y);
    const long after = test::allocations;
    CAPTURE(row.name);
    CHECK(after == before);
  }
}
