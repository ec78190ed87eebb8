// Closed-form flight: right in itself, and the measure of the integrators.
#include "sim/flight/flight.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/body/body_system.h"
#include "sim/math/frames.h"
#include "sim/ode/integrator.h"
#include "tests/body/bodies.h"
#include "tests/catch.h"

using namespace tumble;
using namespace tumble::test;

namespace {

/// The body after `steps` equal steps of an integrator.
RigidBody integrated(const Integrator& row, const RigidBody& start, double duration, int steps) {
  BodySystem system(kGravity, {}, {start});
  std::vector<double> y(system.size());
  system.toArray(y);
  const auto stepper = row.make(system.size());
  const double h = duration / steps;
  for (int n = 0; n < steps; ++n) stepper->step(system, n * h, h, y);
  system.fromArray(y);
  return system.bodies()[0];
}

/// Angle [rad] between two attitudes.
double angleBetween(const Quat& a, const Quat& b) {
  return 2.0 * (a.conjugate() * b).vec().norm();
}

/// The body at t [s] of a flight that it begins at 0.
RigidBody flown(const RigidBody& start, double t) {
  RigidBody body = start;
  Flight(start, kGravity, 0.0).at(t, body);
  return body;
}

}  // namespace

// Oracle: central differences of the pose. Measured 4e-9, allowed 1e-7.
TEST_CASE("velocity and angular velocity of a flight are the change of its pose") {
  const double t0 = 1.5, h = 1e-6;
  const Flight flight(tumblingBrick(), kGravity, t0);
  RigidBody body = tumblingBrick();
  for (const double t : {0.8, 1.5, 3.8}) {
    flight.at(t, body);
    const Pose before = flight.pose(t - h), after = flight.pose(t + h);
    const Vec3 v = (after.x - before.x) / (2.0 * h);
    const Vec3 omega = 2.0 * (after.q * before.q.conjugate()).vec() / (2.0 * h);
    CHECK((body.v - v).norm() < 1e-7);
    CHECK((body.omega - omega).norm() < 1e-7);
    CHECK(flight.pose(t).x == body.x);
    CHECK(flight.pose(t).q.coeffs() == body.q.coeffs());
  }
}

// Oracle: conservation; the energy of the spin and L stay, and at the start all is as it was given.
// Measured 2e-15, allowed 1e-13.
TEST_CASE("a free spin keeps its angular momentum and its energy") {
  RigidBody ball = makeBody(solidMass(Sphere{0.3}, 2.0));
  setVelocity(ball, {1.0, 2.0, 3.0}, {4.0, -5.0, 6.0});
  RigidBody plate = makeBody(solidMass(Box{{0.4, 0.4, 0.1}}, 2.0));
  setVelocity(plate, Vec3::Zero(), {1.0, -2.0, 3.0});
  for (const RigidBody& start : {tumblingBrick(), tumblingCylinder(), plate, ball}) {
    CHECK(angleBetween(flown(start, 0.0).q, start.q) < 1e-15);
    for (const double t : {0.5, 3.0, 20.0}) {
      const RigidBody body = flown(start, t);
      CHECK(body.L == start.L);
      CHECK(body.L.dot(body.omega) == Approx(start.L.dot(start.omega)).epsilon(1e-13));
      CHECK((body.P - start.P - t * start.M * kGravity).norm() < 1e-13);
    }
  }
}

TEST_CASE("a fixed body does not fall") {
  RigidBody table = turntable();
  Flight(table, kGravity, 0.0).at(2.0, table);
  CHECK((table.x - Vec3(0.4, 0.0, -0.2)).norm() < 1e-15);
  CHECK(angleBetween(table.q, fromAxisAngle({0.0, 1.0, 0.0}, 3.3)) < 1e-15);
  CHECK(table.v == turntable().v);
}

// Oracle: second differences of the path of many points. The bound is met to 30 % by some.
TEST_CASE("no point of a body is accelerated by more than the bound of its flight") {
  const double h = 1e-4, r = 0.7;
  for (const RigidBody& start : {tumblingBrick(), tumblingCylinder(), turntable()}) {
    const Flight flight(start, kGravity, 0.0);
    const double bound = flight.accelBound(r);
    double most = 0.0;
    for (int n = 0; n < 500; ++n) {
      const Vec3 p_B =
          r * Vec3(std::cos(n), std::sin(n) * std::cos(7 * n), std::sin(n) * std::sin(7 * n));
      const double t = 0.01 * n;
      const Vec3 change = toWorld(flight.pose(t - h), p_B) + toWorld(flight.pose(t + h), p_B) -
                          2.0 * toWorld(flight.pose(t), p_B);
      most = std::max(most, change.norm() / (h * h));
    }
    CHECK(most < bound * (1.0 + 1e-6));
    CHECK(most > 0.7 * bound);
  }
}

// Oracle: closed form. Second order and more integrate a parabola to rounding. Measured 1e-14.
TEST_CASE("a projectile with spin is on its parabola to 1e-12", "[figures]") {
  const RigidBody start = tumblingCylinder();
  const Vec3 exact = Flight(start, kGravity, 0.0).pose(2.0).x;
  for (const Integrator& row : integrators()) {
    if (row.order < 2) continue;
    const double error = (integrated(row, start, 2.0, 480).x - exact).norm() / exact.norm();
    WARN("projectile, " << row.name << ", 2 s: position error " << error << " relative");
    CHECK(error < 1e-12);
  }
}

// Oracle: order of convergence to the closed form of two rotations. Measured 4.00, 2.00, 1.00.
TEST_CASE("the attitude of a symmetric body converges with orders 4, 2 and 1", "[figures]") {
  const RigidBody start = tumblingCylinder();
  const Quat exact = Flight(start, kGravity, 0.0).pose(2.0).q;
  for (const char* name : {"rk4", "midpoint", "euler"}) {
    const Integrator& row = *findIntegrator(name);
    const auto error = [&](int steps) {
      return angleBetween(integrated(row, start, 2.0, steps).q, exact);
    };
    const int steps = row.order == 1 ? 12800 : 400;
    const double coarse = error(steps), fine = error(2 * steps), order = std::log2(coarse / fine);
    WARN("attitude, " << name << ", " << 2 * steps << " steps: error " << fine << " rad, order "
                      << order);
    CHECK(order == Approx(row.order).margin(0.1));
  }
}

// Oracle: closed form; the adaptive integrator meets it within its tolerance times the time.
// Measured 2e-10 rad, allowed 2e-9.
TEST_CASE("the adaptive integrator meets the closed form of a symmetric body") {
  const RigidBody start = tumblingCylinder();
  const RigidBody end = integrated(*findIntegrator("dopri5"), start, 2.0, 1);
  CHECK(angleBetween(end.q, Flight(start, kGravity, 0.0).pose(2.0).q) < 2e-9);
}

// Oracle: conservation. P keeps its bits; L about the origin is x × P + L, where x rounds.
// Measured 1e-13, allowed 1e-12 relative.
TEST_CASE("the momentum of a free scene drifts by less than 1e-12", "[figures]") {
  const std::vector<RigidBody> start = {tumblingBrick(), tumblingCylinder()};
  const std::vector<Force> none;
  const auto momentum = [](std::span<const RigidBody> bodies) {
    Vec6 sum = Vec6::Zero();
    for (const RigidBody& body : bodies) {
      sum.head<3>() += body.P;
      sum.tail<3>() += body.x.cross(body.P) + body.L;
    }
    return sum;
  };
  for (const Integrator& row : integrators()) {
    BodySystem system(Vec3::Zero(), none, start);
    if (!suits(row, system)) continue;
    std::vector<double> y(system.size());
    system.toArray(y);
    const auto stepper = row.make(system.size());
    double drift = 0.0;
    for (int n = 0; n < 2400; ++n) {
      stepper->step(system, n / 240.0, 1.0 / 240.0, y);
      system.fromArray(y);
      const Vec6 before = momentum(start), change = momentum(system.bodies()) - before;
      drift = std::max({drift, change.head<3>().norm() / before.head<3>().norm(),
                        change.tail<3>().norm() / before.tail<3>().norm()});
    }
    WARN("free scene, " << row.name << ", 10 s: momentum drift " << drift << " relative");
    CHECK(drift < 1e-12);
  }
}

// Oracle: conservation; a spring acts on both ends, whatever the step. Measured 8e-15.
TEST_CASE("a spring between two bodies changes no total momentum") {
  const std::vector<Force> spring = {
      Spring{0, 1, {0.1, 0.0, 0.2}, {0.0, 0.4, 0.0}, 80.0, 0.5, 0.6}};
  BodySystem system(Vec3::Zero(), spring, {tumblingBrick(), tumblingCylinder()});
  const Vec3 before = system.bodies()[0].P + system.bodies()[1].P;
  const Vec3 alone = system.bodies()[0].P;
  std::vector<double> y(system.size());
  system.toArray(y);
  const auto stepper = findIntegrator("rk4")->make(system.size());
  for (int n = 0; n < 240; ++n) stepper->step(system, n / 240.0, 1.0 / 240.0, y);
  system.fromArray(y);
  CHECK((system.bodies()[0].P + system.bodies()[1].P - before).norm() < 1e-12);
  CHECK((system.bodies()[0].P - alone).norm() > 1.0);
}
