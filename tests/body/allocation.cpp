// A step allocates nothing once warm. This program counts its allocations.
#include <cstdlib>
#include <new>
#include <vector>

#include "sim/body/body_system.h"
#include "sim/ode/integrator.h"
#include "tests/body/bodies.h"
#include "tests/catch.h"

namespace {
long allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}

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
    const long before = allocations;
    stepper->step(system, 0.0, 0.1, y);
    const long after = allocations;
    CAPTURE(row.name);
    CHECK(after == before);
  }
}
