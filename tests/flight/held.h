// Tops: bodies held at a point.
#pragma once

#include "sim/body/pivot.h"
#include "sim/math/frames.h"
#include "tests/body/bodies.h"

namespace tumble::test {

/// A disc of 1 kg and radius 0.1 m, thin, 0.1 m from its pivot along its axis, the body Y.
inline RigidBody disc() {
  return makeBody({1.0, Vec3(0.0025, 0.005, 0.0025).asDiagonal()});
}

struct Held {
  RigidBody body;
  Pivot pivot;
};

/// The body, turned, held at c_B and given an angular velocity [rad/s], world frame.
inline Held held(RigidBody body, const Quat& q, const Vec3& c_B, const Vec3& omega) {
  body.q = q;
  updateDerived(body);
  const Pivot pivot = makePivot(body, 0, c_B);
  setVelocity(body, omega.cross(body.x - pivot.p), omega);
  return {body, pivot};
}

/// The disc at 60° from the vertical with ω₃ [rad/s] in all about its axis, precessing at `rate`.
inline Held precessing(double spin, double rate) {
  const Quat q = fromAxisAngle({0.0, 0.0, -1.0}, 3.14159265358979323846 / 3.0);
  const Vec3 axis = q * Vec3::UnitY();
  return held(disc(), q, {0.0, -0.1, 0.0}, rate * Vec3::UnitY() + (spin - rate * axis.y()) * axis);
}

}  // namespace tumble::test
