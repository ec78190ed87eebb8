#include "sim/body/rigid_body.h"

#include <cassert>

#include "sim/math/rotation.h"

namespace tumble {

namespace {

/// Iinv = R IbodyInv Rᵀ. One function for all, as Eigen rounds by the way in which a product is
/// stored.
void turnInertia(const RigidBody& body, const Mat3& R, Mat3& Iinv) {
  Iinv = R * body.IbodyInv * R.transpose();
}

/// Everything that follows from R and the momenta.
void derive(RigidBody& body) {
  if (!body.particle && body.fixed()) body.Iinv.setZero();
  if (!body.particle && !body.fixed()) turnInertia(body, body.R, body.Iinv);
  updateVelocities(body);
}

void put(const Vec3& v, double* y) {
  for (int k = 0; k < 3; ++k) y[k] = v[k];
}

Vec3 vec3(const double* y) {
  return {y[0], y[1], y[2]};
}

/// ½ (0, ω)(w, u) = ½ (−ω·u, w ω + ω × u).
void quaternionRate(const Quat& q, const Vec3& omega, double* rate) {
  const Vec3 u = q.vec();
  rate[0] = -0.5 * omega.dot(u);
  put(0.5 * (q.w() * omega + omega.cross(u)), rate + 1);
}

}  // namespace

[[gnu::flatten]] void updateDerived(RigidBody& body) {
  body.R = rotationMatrix(body.q);
  derive(body);
}

void updateDerived(RigidBody& body, const Mat3& R) {
  body.R = R;
  body.q = nearestRotation(R);
  derive(body);
}

[[gnu::flatten]] void updateVelocities(RigidBody& body) {
  if (body.particle || !body.fixed()) body.v = body.invM * body.P;
  if (!body.particle && !body.fixed()) body.omega = body.Iinv * body.L;
}

[[gnu::flatten]] Vec3 angularVelocityAt(const RigidBody& body, const Quat& q, const Vec3& L) {
  Mat3 Iinv;
  turnInertia(body, rotationMatrix(q), Iinv);
  return Iinv * L;
}

void stateToArray(const RigidBody& body, std::span<double> y, Attitude attitude) {
  assert(static_cast<int>(y.size()) >= stateSize(body, attitude));
  double* to = y.data();
  put(body.x, to), to += 3;
  if (!body.particle && attitude == Attitude::Quaternion) {
    *to = body.q.w();
    put(body.q.vec(), to + 1), to += 4;
  } else if (!body.particle) {
    for (int row = 0; row < 3; ++row, to += 3) put(body.R.row(row), to);
  }
  put(body.P, to), to += 3;
  if (!body.particle) put(body.L, to);
}

void arrayToState(std::span<const double> y, RigidBody& body, Attitude attitude) {
  assert(static_cast<int>(y.size()) >= stateSize(body, attitude));
  const double* from = y.data();
  body.x = vec3(from), from += 3;
  Mat3 R;
  if (!body.particle && attitude == Attitude::Quaternion) {
    body.q = Quat(from[0], from[1], from[2], from[3]), from += 4;
  } else if (!body.particle) {
    for (int row = 0; row < 3; ++row, from += 3) R.row(row) = vec3(from);
  }
  body.P = vec3(from), from += 3;
  if (!body.particle) body.L = vec3(from);
  if (!body.particle && attitude == Attitude::Matrix) return updateDerived(body, R);
  updateDerived(body);
}

void stateDerivative(const RigidBody& body, std::span<double> ydot, Attitude attitude) {
  assert(static_cast<int>(ydot.size()) >= stateSize(body, attitude));
  double* to = ydot.data();
  put(body.v, to), to += 3;
  if (!body.particle && attitude == Attitude::Quaternion) {
    quaternionRate(body.q, body.omega, to), to += 4;
  } else if (!body.particle) {
    const Mat3 rate = skew(body.omega) * body.R;
    for (int row = 0; row < 3; ++row, to += 3) put(rate.row(row), to);
  }
  put(body.force, to), to += 3;
  if (!body.particle) put(body.torque, to);
}

void applyImpulse(RigidBody& body, const Vec3& p, const Vec3& J) {
  if (body.fixed()) return;
  body.P += J;
  if (!body.particle) body.L += (p - body.x).cross(J);
  updateVelocities(body);
}

void applyForce(RigidBody& body, const Vec3& p, const Vec3& f) {
  if (body.fixed()) return;
  body.force += f;
  if (!body.particle) body.torque += (p - body.x).cross(f);
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
