// Bodies that tests share: unlike in every respect, so that a swapped axis or sign shows.
#pragma once

#include "sim/body/mass_properties.h"
#include "sim/math/rotation.h"
#include "tests/gravity.h"

namespace tumble::test {

/// A brick of 0.2 × 0.4 × 0.6 m and 3 kg, turned, off the origin, flying and spinning.
inline RigidBody tumblingBrick() {
  RigidBody body = makeBody(solidMass(Box{{0.1, 0.2, 0.3}}, 3.0));
  body.x = {0.3, 1.2, -0.7};
  body.q = fromAxisAngle({1.0, 2.0, -0.5}, 0.8);
  setVelocity(body, {1.0, -2.0, 0.5}, {3.0, 1.0, -2.0});
  return body;
}

/// A cylinder of 1.5 kg, turned, off the origin, flying and spinning.
inline RigidBody tumblingCylinder() {
  RigidBody body = makeBody(solidMass(Cylinder{0.2, 0.9}, 1.5));
  body.x = {-0.4, 0.6, 0.9};
  body.q = fromAxisAngle({-0.3, 0.4, 1.0}, 2.2);
  setVelocity(body, {-0.5, 3.0, 1.5}, {2.0, -4.0, 1.0});
  return body;
}

/// A body of these moments, turned by q, that spins with omega_B in its own frame.
inline RigidBody spinning(const Vec3& moments, const Quat& q, const Vec3& omega_B) {
  RigidBody body = makeBody({1.0, moments.asDiagonal()});
  body.q = q;
  setVelocity(body, Vec3::Zero(), q * omega_B);
  return body;
}

/// A turntable: fixed, at (0, 0, 0), carried along and turning.
inline RigidBody turntable() {
  return makeFixedBody({Vec3::Zero(), fromAxisAngle({0.0, 1.0, 0.0}, 0.3)}, {0.2, 0.0, -0.1},
                       {0.0, 1.5, 0.0});
}

/// The same body a little later, its velocities kept: for differences.
inline RigidBody moved(RigidBody body, double h) {
  body.x += h * body.v;
  body.q = rotated(body.q, h * body.omega);
  body.R = rotationMatrix(body.q);
  return body;
}

}  // namespace tumble::test
