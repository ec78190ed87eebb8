// Every row of the table of integrators with bodies in its hands: orders, and what it keeps.
#include "sim/ode/integrator.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "sim/body/body_system.h"
#include "tests/body/bodies.h"
#include "tests/catch.h"

using namespace tumble;
using namespace tumble::test;

namespace {

/// Y after `steps` equal steps to time `end`.
template <class SomeSystem>
VecX carried(const Integrator& row, SomeSystem system, double end, int steps, int order = 0) {
  VecX y(system.size());
  const std::span<double> numbers(y.data(), static_cast<std::size_t>(y.size()));
  system.toArray(numbers);
  const auto stepper = row.make(system.size(), {.order = order});
  for (int n = 0; n < steps; ++n) stepper->step(system, n * end / steps, end / steps, numbers);
  return y;
}

RigidBody particle(double m, const Vec3& x, const Vec3& v) {
  RigidBody body = makeParticle(m);
  body.x = x;
  setVelocity(body, v, Vec3::Zero());
  return body;
}

/// Two particles on a spring, one of them tied to the world by another, under gravity.
BodySystem particles() {
  return {
      kGravity,
      {Spring{0, kNoBody, Vec3::Zero(), {0.0, 2.0, 0.0}, 40.0, 0.0, 0.7},
       Spring{0, 1, Vec3::Zero(), Vec3::Zero(), 25.0, 0.0, 0.4}, UniformWind{1, {0.5, 0.0, 0.2}}},
      {particle(0.8, {0.3, 1.0, 0.1}, {1.0, 0.0, -0.5}),
       particle(1.7, {0.9, 0.8, -0.4}, {0.0, 0.6, 0.3})}};
}

/// Two tumbling bodies, pulled, joined by a spring and tied to a fixed body that moves on.
BodySystem tumblingBodies() {
  return {kGravity,
          {PointForce{0, {0.1, -0.2, 0.3}, {2.0, 5.0, -3.0}}, UniformWind{kNoBody, {0.3, 0.1, 0.0}},
           Spring{0, 1, {0.1, 0.0, 0.2}, {0.0, 0.4, 0.0}, 30.0, 0.0, 0.6},
           Spring{1, 2, {0.0, -0.4, 0.0}, {0.3, 0.0, 0.1}, 20.0, 0.0, 0.5}},
          {tumblingBrick(), tumblingCylinder(), turntable()}};
}

/// Observed order of a row towards the end of a fine Taylor series.
void checkOrder(const char* what, const BodySystem& system, const Integrator& row, int order,
                int steps) {
  const double end = 0.6;
  const VecX exact = carried(*findIntegrator("taylor"), system, end, 120, 24);
  const double coarse = (carried(row, system, end, steps, order) - exact).norm();
  const double fine = (carried(row, system, end, 2 * steps, order) - exact).norm();
  const double found = std::log2(coarse / fine);
  WARN(what << ", " << row.name << ", " << 2 * steps << " steps: error " << fine << ", order "
            << found << " of " << order);
  CHECK(found == Approx(order).margin(0.1));
}

void checkOrders(const char* what, const BodySystem& system, int taylorSteps) {
  for (const Integrator& row : integrators()) {
    if (row.adaptive || !suits(row, system)) continue;
    if (row.anyOrder)
      for (const auto& [order, steps] : {std::pair{3, 300}, {6, taylorSteps}})
        checkOrder(what, system, row, order, steps);
    else
      checkOrder(what, system, row, row.order,
                 row.order == 1                    ? 2000
                 : row.needs.split == Split::Exact ? 60
                                                   : 200);
  }
}

/// A system whose step ends without being put back on its manifold.
class Bare : public BodySystem {
 public:
  using BodySystem::BodySystem;
  void normalise(std::span<double>) const override {}
};

}  // namespace

// Oracle: two methods agree, the faster the finer the step; the reference is a Taylor series of
// order 24, which the adaptive row confirms to its tolerance. Measured within 0.07; allowed ± 0.1.
TEST_CASE("every row moves particles with its order", "[figures]") {
  const BodySystem system = particles();
  CHECK(system.size() == 12);
  checkOrders("particles", system, 60);
}

TEST_CASE("every row moves tumbling bodies with its order", "[figures]") {
  checkOrders("tumbling bodies", tumblingBodies(), 160);
}

TEST_CASE("every row moves a top on its pivot with its order", "[figures]") {
  RigidBody top = makeBody(solidMass(Cylinder{0.1, 0.02}, 1.0));
  top.q = fromAxisAngle({0.3, 0.1, 1.0}, 0.8);
  updateDerived(top);
  const Pivot pivot = makePivot(top, 0, {0.0, -0.1, 0.0});
  const Vec3 omega = top.R * Vec3(1.0, 30.0, -2.0);
  setVelocity(top, omega.cross(top.x - pivot.p), omega);
  checkOrders("top on its pivot", BodySystem(kGravity, {}, {top}, {pivot}), 100);
}

// Oracle: two independent methods. Measured 2e-10, of a tolerance of 1e-10 a step; allowed 3e-9.
TEST_CASE("the Taylor series and the adaptive row agree, drag and dampers included") {
  const BodySystem calm = tumblingBodies();
  const BodySystem dragged(
      kGravity,
      {LinearDrag{kNoBody, 0.8, 0.05}, LinearDrag{1, 0.1, 0.2},
       Spring{0, 1, {0.1, 0.0, 0.2}, {0.0, 0.4, 0.0}, 30.0, 0.9, 0.6},
       Spring{1, 2, {0.0, -0.4, 0.0}, {0.3, 0.0, 0.1}, 20.0, 0.5, 0.5}},
      {tumblingBrick(), tumblingCylinder(), turntable(), particle(0.5, {1, 2, 3}, {3, 2, 1})});
  for (const BodySystem& system : {calm, dragged}) {
    REQUIRE(system.offers().jet);
    const VecX series = carried(*findIntegrator("taylor"), system, 0.6, 60, 24);
    const VecX adaptive = carried(*findIntegrator("dopri5"), system, 0.6, 1);
    CHECK((series - adaptive).norm() < 3e-9);
  }
}

// Oracle: closed form. A spring without rest length is harmonic: x = cos ωt. Measured 2e-15.
TEST_CASE("a particle on a spring oscillates harmonically") {
  const BodySystem system(Vec3::Zero(),
                          {Spring{0, kNoBody, Vec3::Zero(), Vec3::Zero(), 9.0, 0.0, 0.0}},
                          {particle(1.0, {1.0, 0.0, 0.0}, Vec3::Zero())});
  const VecX y = carried(*findIntegrator("taylor"), system, 2.0, 20, 20);
  CHECK(std::abs(y[0] - std::cos(6.0)) < 1e-13);
  CHECK(std::abs(y[3] + 3.0 * std::sin(6.0)) < 1e-13);
}

// Oracle: invariant. Without being normalised, the rows that say so keep unit quaternions; the
// others leave them, by 4e-10 (dopri5), 2e-5 (rk4) and more; the line is 1e-13.
TEST_CASE("the rows that keep the manifold leave unit quaternions by themselves") {
  const Bare system(kGravity, {PointForce{0, {0.1, -0.2, 0.3}, {2.0, 5.0, -3.0}}},
                    {tumblingBrick()});
  for (const Integrator& row : integrators()) {
    if (!suits(row, system)) continue;
    const VecX y = carried(row, system, 10.0, row.adaptive ? 1 : 400, 4);
    const double miss = std::abs(y.segment<4>(3).norm() - 1.0);
    CAPTURE(row.name, miss);
    CHECK((miss < 1e-13) == row.keeps.manifold);
  }
}

// Oracle: conservation, closed form of two rotations. A body with two equal moments turns exactly:
// allowed 1e-12; an uneven one misses by 0.13, so the test can fail.
TEST_CASE("the free turn of a symmetric body is exact, that of an uneven one is not") {
  const RigidBody cylinder = tumblingCylinder(), brick = tumblingBrick();
  const FreeTurn even(cylinder.IbodyInv), uneven(brick.IbodyInv);
  CHECK(even.exact());
  CHECK_FALSE(uneven.exact());
  const auto miss = [](const FreeTurn& turn, const RigidBody& body) {
    Quat q = body.q;
    for (int n = 0; n < 100; ++n) q = turn(q, body.L, 0.01);
    return (q.conjugate() * turn(body.q, body.L, 1.0)).vec().norm();
  };
  CHECK(miss(even, cylinder) < 1e-12);
  CHECK(miss(uneven, brick) > 1e-3);
}

// Oracle: the same body described in another frame. Measured 4e-15, allowed 1e-13.
TEST_CASE("a free turn does not care about the body's frame") {
  const RigidBody brick = tumblingBrick();
  const Quat tilt = fromAxisAngle({1.0, -2.0, 0.5}, 1.1);  // new frame to old
  const Mat3 T = rotationMatrix(tilt);
  const Quat straight = FreeTurn(brick.IbodyInv)(brick.q, brick.L, 0.3);
  const Quat tilted = FreeTurn(T.transpose() * brick.IbodyInv * T)(brick.q * tilt, brick.L, 0.3);
  CHECK((straight.conjugate() * tilted * tilt.conjugate()).vec().norm() < 1e-13);
}

TEST_CASE("bodies say what they offer") {
  const auto offers = [](const std::vector<Force>& forces, const RigidBody& body,
                         Attitude attitude = Attitude::Quaternion) {
    return BodySystem(kGravity, forces, {body}, {}, attitude).offers();
  };
  CHECK(offers({}, tumblingBrick()).split == Split::Symmetric);
  CHECK(offers({}, tumblingCylinder()).split == Split::Exact);
  CHECK(offers({}, particle(1.0, Vec3::Zero(), Vec3::Zero())).split == Split::Exact);
  CHECK(offers({LinearDrag{0, 1.0, 0.0}}, tumblingBrick()).split == Split::Rough);
  CHECK(offers({LinearDrag{0, 1.0, 0.0}}, tumblingBrick()).jet);
  CHECK(offers({}, tumblingBrick(), Attitude::Matrix).split == Split::None);
  CHECK_FALSE(offers({}, tumblingBrick(), Attitude::Matrix).jet);
  CHECK(offers({}, tumblingBrick(), Attitude::Matrix).lie);
}
