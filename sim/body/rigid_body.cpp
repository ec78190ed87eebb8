#include "sim/body/rigid_body.h"

#include <cassert>

#include "sim/math/rotation.h"

namespace tumble {

void updateDerived(RigidBody& body) {
  body.R = rotationMatrix(body.q);
  if (body.fixed()) {
    body.Iinv.setZero();
    return;
  }
  body.Iinv = body.R * body.IbodyInv * body.R.transpose();
  body.v = body.invM * body.P;
  body.omega = body.Iinv * body.L;
}

void stateToArray(const RigidBody& body, std::span<double> y) {
  assert(y.size() >= kStateSize);
  const Quat& q = body.q;
  const double state[kStateSize] = {
      body.x.x(), body.x.y(), body.x.z(),         //
      q.w(),      q.x(),      q.y(),      q.z(),  //
      body.P.x(), body.P.y(), body.P.z(),         //
      body.L.x(), body.L.y(), body.L.z(),
  };
  for (int i = 0; i < kStateSize; ++i) y[i] = state[i];
}

void arrayToState(std::span<const double> y, RigidBody& body) {
  assert(y.size() >= kStateSize);
  body.x = Vec3(y[0], y[1], y[2]);
  body.q = Quat(y[3], y[4], y[5], y[6]);
  body.P = Vec3(y[7], y[8], y[9]);
  body.L = Vec3(y[10], y[11], y[12]);
  updateDerived(body);
}

void stateDerivative(const RigidBody& body, std::span<double> ydot) {
  assert(ydot.size() >= kStateSize);
  const Vec3 u = body.q.vec();
  // ½ (0, ω)(w, u) = ½ (−ω·u, w ω + ω × u).
  const double wdot = -0.5 * body.omega.dot(u);
  const Vec3 udot = 0.5 * (body.q.w() * body.omega + body.omega.cross(u));
  const double rates[kStateSize] = {
      body.v.x(),
      body.v.y(),
      body.v.z(),  //
      wdot,
      udot.x(),
      udot.y(),
      udot.z(),  //
      body.force.x(),
      body.force.y(),
      body.force.z(),  //
      body.torque.x(),
      body.torque.y(),
      body.torque.z(),
  };
  for (int i = 0; i < kStateSize; ++i) ydot[i] = rates[i];
}

void applyImpulse(RigidBody& body, const Vec3& p, const Vec3& J) {
  if (body.fixed()) return;
  body.P += J;
  body.L += (p - body.x).cross(J);
  updateDerived(body);
}

void applyForce(RigidBody& body, const Vec3& p, const Vec3& f) {
  if (body.fixed()) return;
  body.force += f;
  body.torque += (p - body.x).cross(f);
}

void setVelocity(RigidBody& body, const Vec3& v, const Vec3& omega) {
  if (body.fixed()) {
    body.v = v;
    body.omega = omega;
  } else {
    const Mat3 R = rotationMatrix(body.q);
    body.P = body.M * v;
    body.L = R * (body.Ibody * (R.transpose() * omega));
  }
  updateDerived(body);
}

double kineticEnergy(const RigidBody& body) {
  // ω·I ω = ω·L.
  return body.fixed() ? 0.0 : 0.5 * (body.P.dot(body.v) + body.L.dot(body.omega));
}

}  // namespace tumble
