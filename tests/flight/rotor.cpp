// The free rotor against Taylor series in extended precision: everywhere, and beside its limits.
#include "sim/flight/rotor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/flight/flight.h"
#include "tests/body/bodies.h"
#include "tests/catch.h"
#include "tests/flight/taylor_reference.h"

using namespace tumble;
using namespace tumble::test;

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
const Quat kTurned = fromAxisAngle({1.0, 2.0, -0.5}, 0.8);

RigidBody weightless(const RigidBody& start, double t) {
  RigidBody body = start;
  Flight(start, Vec3::Zero(), 0.0).at(t, body);
  return body;
}

/// Angle [rad] between the flight and the reference after t [s].
double attitudeError(const RigidBody& start, double t) {
  return angleTo(taylorFlight(freeTop<Extended>(start), Extended(t)).q, weightless(start, t).q);
}

/// |I ω|, of the derived quantities, against |L|.
double momentumError(const RigidBody& body) {
  const Vec3 omega_B = body.R.transpose() * body.omega;
  return std::abs((body.Ibody * omega_B).norm() / body.L.norm() - 1.0);
}

double energyError(const RigidBody& body, const RigidBody& start) {
  return std::abs(body.L.dot(body.omega) / start.L.dot(start.omega) - 1.0);
}

RigidBody flippingBrick(double wobble) {
  return spinning(solidMass(Box{{0.05, 0.1, 0.15}}, 1.0).inertia.diagonal(), kTurned,
                  {wobble, 10.0, 0.0});
}

}  // namespace

// Oracle: conservation. Energy and |I ω| are those of the derived quantities, with the rounding of
// their own; L is never touched.
TEST_CASE("a brick that flips about its middle axis keeps energy and angular momentum",
          "[figures]") {
  const RigidBody start = flippingBrick(1e-3);
  const Flight flight(start, Vec3::Zero(), 0.0);
  RigidBody body = start;
  double energy = 0.0, momentum = 0.0;
  bool same = true;
  for (int n = 1; n <= 1000; ++n) {
    flight.at(0.01 * n, body);
    energy = std::max(energy, energyError(body, start));
    momentum = std::max(momentum, momentumError(body));
    same = same && body.L == start.L;
  }
  WARN("flipping brick, 10 s: energy " << energy << ", |I omega| " << momentum
                                       << " relative; L keeps its bits: " << same);
  CHECK(energy < 5e-15);
  CHECK(momentum < 5e-15);
  CHECK(same);
}

// Oracle: conservation; the attitude of a rotor is a rotation whatever its phase.
TEST_CASE("a million seconds of free spin change neither energy nor momentum", "[figures]") {
  double energy = 0.0, momentum = 0.0;
  for (const double t : {1e6, 1e6 + 0.3, 1e6 + 0.7, 1e8}) {
    for (const RigidBody& start : {flippingBrick(1e-3), flippingBrick(3.0), tumblingBrick()}) {
      const RigidBody body = weightless(start, t);
      energy = std::max(energy, energyError(body, start));
      momentum = std::max(momentum, momentumError(body));
    }
  }
  WARN("free spin, 1e6 s and more: energy " << energy << ", |I omega| " << momentum << " relative");
  CHECK(energy < 1e-14);
  CHECK(momentum < 1e-14);
}

// Oracle: extended precision, with axes and senses in every order. Measured 0.6 ε|ω|T, allowed 3.
TEST_CASE("a free body turns as Euler's equations say, whatever its axes are called") {
  const double t = 2.0;
  for (const Vec3& I :
       {Vec3(1, 2, 3), Vec3(3, 2, 1), Vec3(2, 3, 1), Vec3(1, 3, 2), Vec3(3, 1, 2), Vec3(2, 1, 3)}) {
    for (const Vec3& omega : {Vec3(3, 5, -2), Vec3(-1, 1, 6), Vec3(6, -1, 0.5)}) {
      const RigidBody start = spinning(I, kTurned, omega);
      CHECK(attitudeError(start, t) < 3.0 * kEpsilon * omega.norm() * t);
      CHECK(attitudeError(start, 0.0) < 4.0 * kEpsilon);
    }
  }
}

// Oracle: extended precision. The spin passes the separatrix, where  d₃ l₃² = d₁ l₁²  and a
// difference of them would have no digits left.
TEST_CASE("a spin on either side of the separatrix loses no digits") {
  const double t = 3.0;
  // On it, ω₁ : ω₃ = √(I₃ (I₃ − I₂)) : √(I₁ (I₂ − I₁)) = √3 : 1.
  for (const double excess : {-1e-3, -1e-9, -1e-15, 0.0, 1e-15, 1e-9, 1e-3}) {
    const RigidBody start =
        spinning({1, 2, 3}, kTurned, {std::sqrt(3.0) * (1.0 + excess), 4.0, 1.0});
    INFO("excess " << excess);
    CHECK(attitudeError(start, t) < 3.0 * kEpsilon * 5.0 * t);
  }
}

// Oracle: extended precision. Where η is taken as a difference from K′, or a small amplitude as
// one from 1, the error grows as the wobble vanishes.
TEST_CASE("a wobble about an axis may be as small as it likes") {
  const double t = 2.0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double wobble : {1e-1, 1e-3, 1e-5, 1e-8, 1e-11, 1e-14, 1e-17, 0.0}) {
      Vec3 omega = Vec3::Constant(10.0 * wobble);
      omega[axis] = 10.0;
      const RigidBody start = spinning({1, 2, 3}, Quat::Identity(), omega);
      INFO("axis " << axis << ", wobble " << wobble);
      CHECK(attitudeError(start, t) < 3.0 * kEpsilon * omega.norm() * t);
    }
  }
}

// Oracle: extended precision. Sphere, symmetric body and steady spin are 0/0 in the general
// formulae.
TEST_CASE("bodies with equal moments, and nearly equal ones, are no worse than others") {
  const double t = 2.0;
  const Vec3 omega(3.0, 5.0, -2.0);
  for (const double change : {0.0, 2.3e-16, 1e-14, 1e-11, 1e-8, 1e-5, 1e-2}) {
    for (const double sign : {1.0, -1.0}) {
      const double near = 1.0 + sign * change;
      for (const Vec3& I : {Vec3(1, near, 2), Vec3(near, 1, 0.5), Vec3(1, 1, near),
                            Vec3(1, near, 1.0 + 2.0 * change)}) {
        INFO("moments " << I.transpose() << ", change " << sign * change);
        CHECK(attitudeError(spinning(I, kTurned, omega), t) < 3.0 * kEpsilon * omega.norm() * t);
        // Across the axis of symmetry, and along it.
        for (const Vec3& along : {Vec3(0, 5, 3), Vec3(5, 0, 0), Vec3(0, 0, 5)}) {
          CHECK(attitudeError(spinning(I, Quat::Identity(), along), t) <
                3.0 * kEpsilon * along.norm() * t);
        }
      }
    }
  }
}

// Oracle: extended precision. A rod of 1 : 1e6 turns at 1500 rad/s about its own axis.
TEST_CASE("a thin rod turns as exactly as a brick") {
  const RigidBody start = spinning({1e-6, 1.0, 1.1}, kTurned, {3.0, 5.0, -2.0});
  CHECK(attitudeError(start, 0.01) < 3.0 * kEpsilon * 1500.0 * 0.01);
}

// Oracle: a body frame along the principal axes.
TEST_CASE("products of inertia turn the frame, not the body") {
  const RigidBody straight = spinning({1, 2, 3}, kTurned, {3.0, 5.0, -2.0});
  const Quat tilt = fromAxisAngle({0.3, -1.0, 2.0}, 1.1);
  const Mat3 T = rotationMatrix(tilt);
  Mat3 I = T * straight.Ibody * T.transpose();
  I = (0.5 * (I + I.transpose())).eval();
  RigidBody tilted = makeBody({1.0, I});
  tilted.q = straight.q * tilt.conjugate();
  setVelocity(tilted, Vec3::Zero(), straight.omega);
  for (const double t : {0.0, 0.7, 3.0}) {
    const Quat difference =
        (weightless(tilted, t).q * tilt).conjugate() * weightless(straight, t).q;
    CHECK(2.0 * difference.vec().norm() < 1e-13);
  }
}

TEST_CASE("a body that does not spin stays as it is, and one flight is like another") {
  const RigidBody still = spinning({1, 2, 3}, kTurned, Vec3::Zero());
  CHECK((weightless(still, 7.0).q.coeffs() - kTurned.coeffs()).norm() < 1e-15);
  const RigidBody start = tumblingBrick();
  CHECK(weightless(start, 1.7).q.coeffs() == weightless(start, 1.7).q.coeffs());
}

TEST_CASE("the quaternion of a flight never jumps to its negative") {
  for (const RigidBody& start : {flippingBrick(1e-3), flippingBrick(3.0), tumblingCylinder()}) {
    const Flight flight(start, Vec3::Zero(), 0.0);
    Quat before = start.q;
    for (int n = 0; n <= 2000; ++n) {
      const Quat now = flight.pose(0.01 * n).q;
      CHECK(before.dot(now) > 0.9);
      before = now;
    }
  }
}
