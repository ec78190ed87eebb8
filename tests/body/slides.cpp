// Derivations of the slides, by finite differences of motions that an integrator makes.
#include <cmath>
#include <vector>

#include <span>

#include "sim/body/body_system.h"
#include "sim/ode/integrator.h"
#include "tests/body/bodies.h"
#include "tests/catch.h"

using namespace tumble;
using namespace tumble::test;

namespace {

const std::vector<Force> kPull = {PointForce{0, {0.1, -0.2, 0.3}, {2.0, 5.0, -3.0}}};

/// Y of the pulled brick at t [s], by a series that is exact to rounding.
VecX at(double t) {
  const RigidBody start = tumblingBrick();
  const BodySystem system(kGravity, kPull, {start});
  VecX y(kStateSize);
  const std::span<double> numbers(y.data(), kStateSize);
  stateToArray(start, numbers);
  findIntegrator("taylor")->make(kStateSize, {.order = 20})->step(system, 0.0, t, numbers);
  return y;
}

RigidBody bodyAt(double t) {
  RigidBody body = tumblingBrick();
  const VecX y = at(t);
  arrayToState({y.data(), kStateSize}, body);
  return body;
}

}  // namespace

// Oracle: order of convergence. The central difference of a solution misses the derivative by h².
// Measured order 2.000, allowed ± 0.02 (slides SD5, SF4).
TEST_CASE("the derivative is what the difference of a solution tends to, by h squared") {
  const BodySystem system(kGravity, kPull, {tumblingBrick()});
  const VecX y = at(0.0);
  VecX rate(kStateSize);
  system.derivative(0.0, {y.data(), kStateSize}, {rate.data(), kStateSize});
  const auto miss = [&](double h) { return ((at(h) - at(-h)) / (2.0 * h) - rate).norm(); };
  CHECK(std::log2(miss(0.02) / miss(0.01)) == Approx(2.0).margin(0.02));
  CHECK(miss(0.01) < 1e-2);
}

// Oracle: order of convergence; with ω* for −ω* or for its transpose nothing would converge.
// Measured order 2.000, allowed ± 0.02 (slides SD18, SF18).
TEST_CASE("the matrix of a flying body changes by omega star times itself") {
  const RigidBody body = bodyAt(0.0);
  const auto miss = [&](double h) {
    return ((bodyAt(h).R - bodyAt(-h).R) / (2.0 * h) - skew(body.omega) * body.R).norm();
  };
  CHECK(std::log2(miss(0.02) / miss(0.01)) == Approx(2.0).margin(0.02));
  CHECK(miss(0.001) < 1e-4);  // measured 4.7e-5
}

// Oracle: the derivation on the slides,  d/dt (I ω) = İ ω + I ω̇ = ω × I ω + I ω̇ = τ,  each term by
// central differences of 1e-4. Measured 1.3e-7 of 2 N m, allowed 1e-6.
TEST_CASE("the rate of I omega is the torque, and the change of I takes its share") {
  RigidBody body = bodyAt(0.0);
  const double h = 1e-4;
  const RigidBody before = bodyAt(-h), after = bodyAt(h);
  const auto inertia = [](const RigidBody& b) { return Mat3(b.R * b.Ibody * b.R.transpose()); };
  sumForces(kGravity, kPull, std::span(&body, 1));
  const Vec3 spinRate = (inertia(after) * after.omega - inertia(before) * before.omega) / (2.0 * h);
  const Vec3 fromInertia = (inertia(after) - inertia(before)) * body.omega / (2.0 * h);
  const Vec3 fromOmega = inertia(body) * (after.omega - before.omega) / (2.0 * h);
  CHECK((spinRate - body.torque).norm() < 1e-6);
  CHECK((fromInertia + fromOmega - body.torque).norm() < 1e-6);
  CHECK((fromInertia - body.omega.cross(inertia(body) * body.omega)).norm() < 1e-6);
  CHECK(fromInertia.norm() > 0.1);
}

// Oracle: closed form. A wheel that turns once in T has |ω| = 2π/T, and is back after T. Measured
// 2e-15, allowed 1e-13 (slides SD16–SD17).
TEST_CASE("a wheel that turns once in two seconds has pi rad/s and is back after them") {
  RigidBody wheel = makeBody(solidMass(Cylinder{0.3, 0.1}, 2.0));
  wheel.q = fromAxisAngle({1.0, 0.5, 0.2}, 0.7);
  updateDerived(wheel);
  const double period = 2.0;
  wheel.L = wheel.R * wheel.Ibody * Vec3(0.0, 2.0 * 3.14159265358979323846 / period, 0.0);
  updateDerived(wheel);
  CHECK(wheel.omega.norm() == Approx(2.0 * 3.14159265358979323846 / period).epsilon(1e-15));
  std::vector<double> y(kStateSize);
  stateToArray(wheel, y);
  const auto stepper = findIntegrator("rkmk4")->make(kStateSize);
  for (int n = 0; n < 20; ++n)
    stepper->step(BodySystem(Vec3::Zero(), {}, {wheel}), 0.0, period / 20.0, y);
  const Quat q(y[3], y[4], y[5], y[6]);
  CHECK((wheel.q.conjugate() * q).vec().norm() < 1e-13);
}
