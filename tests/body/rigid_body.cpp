#include "sim/body/rigid_body.h"

#include <array>
#include <cstring>

#include "sim/math/frames.h"
#include "tests/body/bodies.h"
#include "tests/catch.h"

using namespace tumble;
using namespace tumble::test;

// Oracle: bit equality.
TEST_CASE("a state goes into an array and back without losing a bit, whatever the length of q") {
  std::array<double, kStateSize> y, again;
  for (int i = 0; i < kStateSize; ++i) y[i] = 0.1 * i - 1.0 / 3.0;
  RigidBody body = tumblingBrick();
  arrayToState(y, body);
  stateToArray(body, again);
  CHECK(std::memcmp(y.data(), again.data(), sizeof y) == 0);
  // The order is x, q with w first, P, L.
  CHECK((body.x.x() == y[0] && body.q.w() == y[3] && body.q.z() == y[6]));
  CHECK((body.P.x() == y[7] && body.L.z() == y[12]));
}

// Oracle: closed form. Measured 1.4e-15, allowed 1e-14.
TEST_CASE("a body takes the velocities it is given, fixed or free") {
  const Vec3 v(1.0, -2.0, 0.5), omega(3.0, 1.0, -2.0);
  for (RigidBody body : {tumblingBrick(), turntable()}) {
    setVelocity(body, v, omega);
    CHECK((body.v - v).norm() < 1e-14);
    CHECK((body.omega - omega).norm() < 1e-14);
  }
  // L = I ω is not along ω, for I is not a number.
  const RigidBody brick = tumblingBrick();
  const Mat3 I = brick.R * brick.Ibody * brick.R.transpose();
  CHECK((brick.L - I * omega).norm() < 1e-14);
  CHECK(brick.L.normalized().cross(omega.normalized()).norm() > 0.05);
}

// Oracle: central difference of the motion of a material point; the difference itself errs by
// h²/6 |ω|³ r = 1e-11. Measured 8e-11, allowed 1e-9.
TEST_CASE("the velocity of a point of a body is the change of its place") {
  const double h = 1e-6;
  for (const RigidBody& body : {tumblingBrick(), turntable()}) {
    const Vec3 p_B(0.1, -0.2, 0.3);
    const Vec3 difference =
        (toWorld(moved(body, h).pose(), p_B) - toWorld(moved(body, -h).pose(), p_B)) / (2.0 * h);
    CHECK((pointVelocity(body, toWorld(body.pose(), p_B)) - difference).norm() < 1e-9);
  }
}

// Oracle: slide SD18, by central difference. Measured 8e-11, allowed 1e-9.
TEST_CASE("the rotation matrix changes by omega star times itself") {
  const RigidBody body = tumblingBrick();
  const double h = 1e-6;
  const Mat3 difference = (moved(body, h).R - moved(body, -h).R) / (2.0 * h);
  CHECK((difference - skew(body.omega) * body.R).norm() < 1e-9);
}

// Oracle: central difference for x and q, the forces themselves for P and L.
TEST_CASE("the state derivative is the rate at which each number of the state changes") {
  RigidBody body = tumblingBrick();
  body.force = {1.0, 2.0, 3.0};
  body.torque = {-4.0, 5.0, 6.0};
  std::array<double, kStateSize> rate, before, after;
  stateDerivative(body, rate);
  const double h = 1e-6;
  stateToArray(moved(body, -h), before);
  stateToArray(moved(body, h), after);
  for (int i = 0; i < 7; ++i) {
    // Measured 6e-11, allowed 1e-9.
    CHECK(rate[i] == Approx((after[i] - before[i]) / (2.0 * h)).margin(1e-9));
  }
  CHECK((Vec3(rate[7], rate[8], rate[9]) - body.force).norm() == 0.0);
  CHECK((Vec3(rate[10], rate[11], rate[12]) - body.torque).norm() == 0.0);
}

// Oracle: closed forms of momentum, and energy as work: ΔE = J · mean velocity of the struck point.
TEST_CASE("an impulse changes both momenta and brings the energy that its point takes up") {
  RigidBody body = tumblingBrick();
  const RigidBody before = body;
  const Vec3 p = body.x + Vec3(0.1, 0.2, -0.05), J(0.3, -0.7, 1.1);
  applyImpulse(body, p, J);
  CHECK((body.P - before.P - J).norm() < 1e-14);
  CHECK((body.L - before.L - Vec3(0.1, 0.2, -0.05).cross(J)).norm() < 1e-14);
  const double work = 0.5 * J.dot(pointVelocity(before, p) + pointVelocity(body, p));
  // Measured 2e-15, allowed 1e-13.
  CHECK(kineticEnergy(body) - kineticEnergy(before) == Approx(work).margin(1e-13));
}

// Oracle: closed form ½ M v² + ½ Σ I ω² with ω along a principal axis.
TEST_CASE("kinetic energy is that of the flight and that of the spin") {
  RigidBody body = makeBody(solidMass(Box{{0.5, 1.0, 1.5}}, 12.0));
  setVelocity(body, {1.0, 2.0, 2.0}, {0.0, 3.0, 0.0});
  CHECK(kineticEnergy(body) == Approx(0.5 * 12.0 * 9.0 + 0.5 * 10.0 * 9.0));
}

TEST_CASE("a fixed body ignores forces and impulses and keeps its motion") {
  RigidBody table = turntable();
  applyImpulse(table, {1.0, 1.0, 1.0}, {5.0, 6.0, 7.0});
  applyForce(table, {1.0, 1.0, 1.0}, {5.0, 6.0, 7.0});
  updateDerived(table);
  CHECK((table.P.isZero(0.0) && table.L.isZero(0.0) && table.Iinv.isZero(0.0)));
  CHECK((table.force.isZero(0.0) && table.torque.isZero(0.0)));
  CHECK((table.v == Vec3(0.2, 0.0, -0.1) && table.omega == Vec3(0.0, 1.5, 0.0)));
  CHECK(kineticEnergy(table) == 0.0);

  std::array<double, kStateSize> rate;
  stateDerivative(table, rate);
  CHECK((rate[0] == 0.2 && rate[2] == -0.1));
  CHECK(rate[5] == Approx(0.5 * 1.5 * table.q.w()));
}

// Oracle: Σ m (|r|² 1 − r rᵀ) over points that turn with the body. Measured 5e-16, allowed 1e-14.
TEST_CASE("the inertia tensor is constant in the body and turns with it in the world") {
  const double mass[] = {1.0, 2.0, 0.5, 3.0};
  const Vec3 points_B[] = {{0.3, -0.1, 0.2}, {-0.4, 0.2, 0.1}, {0.1, 0.5, -0.3}, {0.0, -0.2, -0.1}};
  const auto tensor = [&](const Mat3& R) {
    Mat3 sum = Mat3::Zero();
    for (int i = 0; i < 4; ++i) {
      const Vec3 r = R * points_B[i];
      sum += mass[i] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    }
    return sum;
  };
  RigidBody body = makeBody({6.5, tensor(Mat3::Identity())});
  const Mat3 constant = body.Ibody;
  for (const double angle : {0.4, 1.7, -2.9}) {
    body.q = fromAxisAngle({1.0, -2.0, 0.7}, angle);
    updateDerived(body);
    const Mat3 world = tensor(body.R);
    CHECK((body.R * body.Ibody * body.R.transpose() - world).norm() < 1e-14);
    CHECK((body.Iinv * world - Mat3::Identity()).norm() < 1e-14);
    CHECK((world - constant).norm() > 0.1);
    CHECK(body.Ibody == constant);
  }
}

// Slides SD14–SD15. Oracle: the round trip itself, R(q) and R(q)ᵀ; points and places of about a
// metre. Measured 7.8e-16 m, allowed 1e-15 m.
TEST_CASE("a point goes to the world and back") {
  double worst = 0.0;
  for (int k = 0; k < 200; ++k) {
    const Pose pose{{0.3 * std::sin(1.1 * k), 0.3 * std::cos(0.7 * k), 0.3 * std::sin(2.3 * k)},
                    fromAxisAngle({std::cos(0.3 * k), std::sin(0.9 * k), 0.4}, 0.1 * k)};
    const Vec3 p_B(0.4 * std::cos(1.9 * k), -0.3, 0.5 * std::sin(0.2 * k));
    worst = std::max(worst, (toBody(pose, toWorld(pose, p_B)) - p_B).norm());
    // By the matrix it is the same point.
    RigidBody body;
    body.x = pose.x;
    body.q = pose.q;
    updateDerived(body);
    CHECK((body.R * p_B + body.x - toWorld(pose, p_B)).norm() < 1e-15);
  }
  CAPTURE(worst);
  CHECK(worst < 1e-15);
}
