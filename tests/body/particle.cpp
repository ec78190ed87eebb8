// Points of mass: what they are made of, how forces move them, and the field they run in.
#include <cmath>
#include <numbers>

#include "sim/body/body_system.h"
#include "sim/ode/integrator.h"
#include "tests/body/bodies.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

const Vec3 kAskewGravity(0.3, -9.81, -0.2);

RigidBody particleAt(const Vec3& x, const Vec3& v, double mass = 0.7) {
  RigidBody body = makeParticle(mass);
  body.x = x;
  setVelocity(body, v, Vec3::Zero());
  return body;
}

/// Carries the system's bodies over n steps of h.
void carry(BodySystem& system, const char* integrator, double h, int n) {
  std::vector<double> y(system.size());
  system.toArray(y);
  const auto stepper = findIntegrator(integrator)->make(system.size());
  for (int k = 0; k < n; ++k) stepper->step(system, k * h, h, y);
  system.fromArray(y);
}

}  // namespace

// Slides SD2, SF3. Oracle: closed form; RK4 has no error of its own on a parabola. Measured 2e-14 m
// and 5e-14 m/s, allowed 1e-12.
TEST_CASE("a thrown particle follows its parabola") {
  const Vec3 x0(0.1, 2.0, -0.4), v0(3.0, 4.0, -1.0);
  BodySystem system(kAskewGravity, {}, {particleAt(x0, v0)});
  carry(system, "rk4", 0.01, 200);
  const double t = 2.0;
  const RigidBody& body = system.bodies()[0];
  CHECK((body.x - (x0 + t * v0 + 0.5 * t * t * kAskewGravity)).norm() < 1e-12);
  CHECK((body.v - (v0 + t * kAskewGravity)).norm() < 1e-12);
}

// Slides SD3, SD6. Oracle: bit-equal round trip; six numbers a particle.
TEST_CASE("a particle's state comes back from Y bit by bit") {
  const RigidBody body = particleAt({1.0 / 3.0, -2e-7, 1e9}, {0.1, 1.0 / 7.0, -3e-30});
  BodySystem system(kAskewGravity, {}, {body});
  REQUIRE(system.size() == 6);
  std::vector<double> y(system.size());
  system.toArray(y);
  RigidBody back = makeParticle(0.7);
  arrayToState(y, back);
  CHECK(back.x == body.x);
  CHECK(back.P == body.P);
  CHECK(back.v == body.v);
}

// Slide SD4. Oracle: Newton's second law, with the sum of two forces and gravity formed by hand.
// Measured 0 units in the last place, allowed 1.
TEST_CASE("the rate of a particle's velocity is force over mass") {
  const double m = 0.7, drag = 0.3;
  const Vec3 push(1.25, -0.5, 2.0);
  const BodySystem system(kAskewGravity, {UniformWind{0, push}, LinearDrag{0, drag, 0.0}},
                          {particleAt({1.0, 2.0, 3.0}, {-1.0, 0.5, 2.0}, m)});
  const int size = system.size();
  std::vector<double> y(size), rate(size);
  system.toArray(y);
  system.derivative(0.0, y, rate);
  const Vec3 v = system.bodies()[0].v, F = m * kAskewGravity + push - drag * v;
  REQUIRE(size == 6);
  for (int k = 0; k < 3; ++k) {
    CHECK(rate[k] == v[k]);
    const double a = F[k] / m;
    CHECK(std::abs(rate[3 + k] / m - a) <= std::abs(a) * 0x1p-52);
  }
}

TEST_CASE("a particle has no inertia, takes no spin and keeps its orientation") {
  RigidBody body = particleAt({1.0, 0.0, 0.0}, {0.0, 2.0, 0.0});
  applyForce(body, {5.0, 5.0, 5.0}, {1.0, 0.0, 0.0});
  CHECK(body.torque.isZero(0.0));
  applyImpulse(body, {5.0, 5.0, 5.0}, {0.7, 0.0, 0.0});
  CHECK(body.v == Vec3(1.0, 2.0, 0.0));
  CHECK(body.L.isZero(0.0));
  CHECK(body.omega.isZero(0.0));
  CHECK(kineticEnergy(body) == Approx(0.5 * 0.7 * 5.0).epsilon(1e-15));
  CHECK_THROWS_AS(makeParticle(0.0), std::invalid_argument);
  CHECK_THROWS_AS(makeParticle(std::nan("")), std::invalid_argument);
}

// Slides SD5–SD8. Oracle: closed form. In the circular field Euler's step multiplies the amplitude
// by √(1 + h²Ω²); over the 63 steps of h = 0.1 nearest to a turn by 1.3681. Measured 7e-16, allowed
// 1e-12.
TEST_CASE("in the circular field Euler spirals out as its step says and midpoint hardly") {
  const Vec3 centre(0.5, -0.3, 0.2);
  const std::vector<Force> field = {CircularField{kNoBody, centre, Vec3::UnitZ()}};
  const auto radiusAfterTurn = [&](const char* integrator) {
    BodySystem system(Vec3::Zero(), field, {particleAt(centre + Vec3::UnitX(), Vec3::UnitY())});
    carry(system, integrator, 0.1, 63);
    return (system.bodies()[0].x - centre).norm();
  };
  // Amplitude, not radius: after 63 steps velocity and radius have both grown by the same factor.
  CHECK(radiusAfterTurn("euler") == Approx(std::pow(1.01, 31.5)).epsilon(1e-12));
  CHECK(std::abs(radiusAfterTurn("midpoint") - 1.0) < 2e-3);
  CHECK(std::abs(radiusAfterTurn("rk4") - 1.0) < 2e-6);
  // Order 12 of the series: what is left out is h¹³/13! a step.
  CHECK(std::abs(radiusAfterTurn("taylor") - 1.0) < 1e-13);
}

// Oracle: closed form of the oscillation across the axis and of the fall along it. Measured 2e-12
// (RK4, h = 1 ms), allowed 1e-10.
TEST_CASE("a particle in the circular field runs on an ellipse and falls along the axis") {
  const Vec3 axis = Vec3(1.0, 2.0, -0.5).normalized(), centre(0.1, 0.2, 0.3);
  const double rate = 3.0, T = 2.0;
  const Vec3 x0(1.0, -0.4, 0.6), v0(0.5, 1.0, -2.0);
  BodySystem system(Vec3::Zero(), {CircularField{0, centre, rate * axis}}, {particleAt(x0, v0)});
  carry(system, "rk4", 1e-3, 2000);
  const auto across = [&](const Vec3& u) { return Vec3(u - axis.dot(u) * axis); };
  const Vec3 expected = centre + across(x0 - centre) * std::cos(rate * T) +
                        across(v0) * (std::sin(rate * T) / rate) +
                        axis * (axis.dot(x0 - centre) + axis.dot(v0) * T);
  CHECK((system.bodies()[0].x - expected).norm() < 1e-10);
}

// Oracle: conservation, the field's potential in the sum. Measured 5e-14 relative (RK4, h = 1 ms),
// allowed 1e-11.
TEST_CASE("kinetic energy and the field's potential add up to a constant") {
  const std::vector<Force> field = {CircularField{kNoBody, {0.3, 0.0, -1.0}, {1.0, 2.0, -0.7}}};
  std::vector<RigidBody> start = {particleAt({1.0, 0.5, -0.2}, {0.4, -2.0, 1.0}),
                                  test::tumblingBrick()};
  BodySystem system(kAskewGravity, field, start);
  const double before = kineticEnergy(start) + potentialEnergy(kAskewGravity, field, start);
  carry(system, "rk4", 1e-3, 3000);
  const double after =
      kineticEnergy(system.bodies()) + potentialEnergy(kAskewGravity, field, system.bodies());
  CHECK(std::abs(after - before) < 1e-11 * std::abs(before));
  CHECK(powerOfForces(field, start) == 0.0);
}

// Slides SD6–SD7. Oracle: bit-equal runs, each particle alone and all together.
TEST_CASE("n particles together move as each does alone, bit for bit") {
  constexpr int kCount = 50;
  std::vector<RigidBody> all;
  for (int i = 0; i < kCount; ++i)
    all.push_back(particleAt({0.1 * i, 1.0 / (i + 1.0), -0.03 * i * i},
                             {std::sqrt(i + 0.5), 3.0 - 0.2 * i, 1.0 / 3.0}, 0.1 + 0.07 * i));
  const std::vector<Force> forces = {LinearDrag{kNoBody, 0.2, 0.0},
                                     CircularField{kNoBody, Vec3::UnitX(), {0.0, 1.5, 0.3}}};
  for (const char* name : {"euler", "symplectic-euler", "midpoint", "rk4"}) {
    CAPTURE(name);
    BodySystem together(kAskewGravity, forces, all);
    carry(together, name, 1.0 / 240.0, 100);
    for (int i = 0; i < kCount; ++i) {
      BodySystem alone(kAskewGravity, forces, {all[i]});
      carry(alone, name, 1.0 / 240.0, 100);
      REQUIRE(alone.bodies()[0].x == together.bodies()[i].x);
      REQUIRE(alone.bodies()[0].P == together.bodies()[i].P);
    }
  }
}
