// One solver for particles and bodies: bodies in the hands of the integrators.
#include "sim/body/body_system.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "sim/ode/integrator.h"
#include "tests/body/bodies.h"
#include "tests/catch.h"

using namespace tumble;
using namespace tumble::test;

namespace {

/// Carries the bodies of a system through equal steps and leaves them there.
void run(std::string_view integrator, BodySystem& system, double h, int steps) {
  const auto stepper = findIntegrator(integrator)->make(system.size());
  std::vector<double> y(system.size());
  system.toArray(y);
  for (int n = 0; n < steps; ++n) stepper->step(system, n * h, h, y);
  system.fromArray(y);
}

}  // namespace

// Oracle: bit equality. (An adaptive step is chosen by the worst body, so its row is left out.)
TEST_CASE("bodies that share no force move as if each were alone") {
  for (const Integrator& row : integrators()) {
    if (row.adaptive) continue;
    std::vector<Force> forces = {LinearDrag{kNoBody, 0.3, 0.1}};
    if (!suits(row, BodySystem(kGravity, forces, {tumblingBrick()}))) forces = {UniformWind{}};
    BodySystem both(kGravity, forces, {tumblingBrick(), tumblingCylinder()});
    BodySystem alone(kGravity, forces, {tumblingCylinder()});
    if (!suits(row, both)) continue;
    run(row.name, both, 0.01, 50);
    run(row.name, alone, 0.01, 50);
    CAPTURE(row.name);
    CHECK(both.bodies()[1].x == alone.bodies()[0].x);
    CHECK(both.bodies()[1].q.coeffs() == alone.bodies()[0].q.coeffs());
    CHECK(both.bodies()[1].L == alone.bodies()[0].L);
  }
}

// Oracle: two methods agree, and the faster the finer the step. Every part of the state is
// compared, under forces of every kind. Measured 1.00, 1.00, 2.00, 4.00; allowed ± 0.1.
TEST_CASE("the integrators converge to one motion of pulled, dragged and sprung bodies") {
  const std::vector<Force> forces = {
      PointForce{0, {0.1, -0.2, 0.3}, {2.0, 5.0, -3.0}}, LinearDrag{1, 0.8, 0.05},
      Spring{0, 1, {0.1, 0.0, 0.2}, {0.0, 0.4, 0.0}, 30.0, 0.5, 0.6}};
  const BodySystem start(kGravity, forces, {tumblingBrick(), tumblingCylinder()});
  const auto end = [&](std::string_view integrator, int steps) {
    BodySystem system = start;
    run(integrator, system, 0.5 / steps, steps);
    VecX y(system.size());
    system.toArray({y.data(), static_cast<std::size_t>(y.size())});
    return y;
  };
  const VecX exact = end("dopri5", 1);
  for (const Integrator& row : integrators()) {
    if (row.adaptive || row.anyOrder || !suits(row, start)) continue;
    const int steps = row.order == 1 ? 4000 : 100;
    const double coarse = (end(row.name, steps) - exact).norm();
    const double fine = (end(row.name, 2 * steps) - exact).norm();
    CAPTURE(row.name, coarse, fine);
    CHECK(std::log2(coarse / fine) == Approx(row.order).margin(0.1));
  }
}

// Oracle: Euler's equations, I ω̇ + ω × I ω = τ in the body frame, by central difference in time.
// Measured 1.2e-7 of 3 N m, from h² d³ω/dt³; allowed 1e-6.
TEST_CASE("the angular velocity of a body obeys Euler's equations") {
  const std::vector<Force> pull = {PointForce{0, {0.1, -0.2, 0.3}, {2.0, 5.0, -3.0}}};
  const RigidBody start = tumblingBrick();
  const double h = 1e-4;
  BodySystem system(kGravity, pull, {start});
  const auto omegaAt = [&](int steps) {
    BodySystem copy = system;
    run("rk4", copy, h, steps);
    return Vec3(copy.bodies()[0].R.transpose() * copy.bodies()[0].omega);
  };
  const Vec3 omega_B = omegaAt(1), rate_B = (omegaAt(2) - omegaAt(0)) / (2.0 * h);
  run("rk4", system, h, 1);
  std::vector<RigidBody> there(system.bodies().begin(), system.bodies().end());
  sumForces(kGravity, pull, there);
  const Vec3 torque_B = there[0].R.transpose() * there[0].torque;
  const Mat3& I = start.Ibody;
  CHECK((I * rate_B + omega_B.cross(I * omega_B) - torque_B).norm() < 1e-6);
}

// Oracle: conservation. Nothing turns the body, yet its spin wanders: L is a constant, ω is not.
// Energy: measured 4e-11 J of 23 J in 10 s, allowed 3e-11 relative.
TEST_CASE("a free brick keeps L and its energy while its angular velocity wanders") {
  const RigidBody start = tumblingBrick();
  BodySystem system(Vec3::Zero(), {}, {start});
  double wander = 0.0;
  for (int second = 0; second < 10; ++second) {
    run("dopri5", system, 1.0 / 60.0, 60);
    const RigidBody& body = system.bodies()[0];
    wander = std::max(wander, (body.omega - start.omega).norm());
    CHECK(body.L == start.L);
    CHECK(kineticEnergy(body) == Approx(kineticEnergy(start)).epsilon(3e-11));
  }
  CHECK(wander > 0.3);
}

// Oracle: the classic instability; the spin about the middle axis reverses, the others stay.
TEST_CASE("a spin about the middle axis turns over, one about the shortest or longest does not") {
  for (int axis = 0; axis < 3; ++axis) {
    RigidBody body = makeBody(solidMass(Box{{0.1, 0.2, 0.3}}, 3.0));
    setVelocity(body, Vec3::Zero(), 6.0 * Vec3::Unit(axis) + Vec3::Constant(0.01));
    BodySystem system(Vec3::Zero(), {}, {body});
    double least = 6.0;
    for (int i = 0; i < 100; ++i) {
      run("rk4", system, 0.01, 10);
      const RigidBody& now = system.bodies()[0];
      least = std::min(least, now.R.col(axis).dot(now.omega));
    }
    CAPTURE(axis, least);
    CHECK((axis == 1 ? least < -5.9 : least > 5.9));
  }
}

// Oracle: closed forms. Fixed bodies have no force, yet they move on: x = vt, a turn of ωt.
// Place: measured 1.5e-15, allowed 1e-12.
TEST_CASE("a turntable turns steadily in every integrator's hands") {
  for (const Integrator& row : integrators()) {
    BodySystem system(kGravity, {}, {turntable()});
    REQUIRE(suits(row, system));
    run(row.name, system, 1.0 / 240.0, 240);
    const RigidBody& table = system.bodies()[0];
    const Quat expected = fromAxisAngle({0.0, 1.0, 0.0}, 1.8);
    // Measured 6e-13 and, by those of low order, 2.4e-6: their own error at this step.
    const double allowed = row.order >= 4 ? 1e-11 : 1e-5;
    CAPTURE(row.name);
    CHECK((table.x - Vec3(0.2, 0.0, -0.1)).norm() < 1e-12);
    CHECK((table.q.coeffs() - expected.coeffs()).norm() < allowed);
  }
}

TEST_CASE("every integrator leaves unit quaternions") {
  for (const Integrator& row : integrators()) {
    BodySystem system(kGravity, {}, {tumblingBrick()});
    if (!suits(row, system)) continue;
    run(row.name, system, 0.05, 20);
    CAPTURE(row.name);
    CHECK(std::abs(system.bodies()[0].q.norm() - 1.0) < 1e-15);
  }
}

// Slide SD11. Oracle: what "rigid" means. 27 points of a spinning brick, through RK4 and the unit
// quaternion it leaves. Measured 1.1e-16 m, allowed 1e-12 m.
TEST_CASE("the points of a rigid body keep their distances") {
  BodySystem system(kGravity, {}, {tumblingBrick()});
  std::vector<Vec3> points_B;
  for (double x : {-0.1, 0.0, 0.1})
    for (double y : {-0.2, 0.0, 0.2})
      for (double z : {-0.3, 0.0, 0.3}) points_B.emplace_back(x, y, z);
  double worst = 0.0;
  for (int round = 0; round < 10; ++round) {
    run("rk4", system, 1e-3, 10'000);
    const RigidBody& body = system.bodies()[0];
    for (const Vec3& p : points_B)
      for (const Vec3& o : points_B)
        worst = std::max(worst, std::abs((body.R * (p - o)).norm() - (p - o).norm()));
  }
  CAPTURE(worst);
  CHECK(worst < 1e-12);
}
