// A body that goes on as it moves.
#pragma once

#include "sim/body/rigid_body.h"
#include "sim/math/rotation.h"

namespace tumble {

/// The body a time t [s] later, at constant v and omega: what ṅ and d²/dt² are held to.
inline RigidBody coasted(RigidBody body, double t) {
  if (body.fixed()) return body;
  const Vec3 v = body.v, omega = body.omega;
  body.x += t * v;
  body.q = rotated(body.q, t * omega);
  updateDerived(body);
  setVelocity(body, v, omega);
  return body;
}

}  // namespace tumble
