#include "sim/body/pivot.h"

#include "sim/body/mass_properties.h"
#include "sim/math/rotation.h"

namespace tumble {
namespace {

/// R M Rᵀ v.
Vec3 turned(const Mat3& R, const Mat3& M_B, const Vec3& v) {
  return R * (M_B * (R.transpose() * v));
}

}  // namespace

Pivot makePivot(const RigidBody& held, int body, const Vec3& c_B) {
  Pivot pivot{.body = body, .c_B = c_B, .p = held.R * c_B + held.x};
  pivot.Ibody =
      held.Ibody + held.M * (c_B.squaredNorm() * Mat3::Identity() - c_B * c_B.transpose());
  pivot.IbodyInv = inverseInertia(pivot.Ibody);
  return pivot;
}

Vec3 momentumAbout(const Pivot& pivot, const RigidBody& body) {
  return body.L - (body.R * pivot.c_B).cross(body.P);
}

void hold(const Pivot& pivot, const Vec3& H, RigidBody& body) {
  const Mat3 R = rotationMatrix(body.q);
  const Vec3 r = -(R * pivot.c_B), omega = turned(R, pivot.IbodyInv, H);
  body.x = pivot.p + r;
  body.P = body.M * omega.cross(r);
  body.L = turned(R, body.Ibody, omega);
  updateDerived(body);
}

Vec3 reaction(const Pivot& pivot, const RigidBody& body) {
  const Vec3 r = -(body.R * pivot.c_B), &omega = body.omega;
  const Vec3 H = turned(body.R, pivot.Ibody, omega);
  const Vec3 torque = body.torque + r.cross(body.force) - omega.cross(H);
  const Vec3 alpha = turned(body.R, pivot.IbodyInv, torque);
  return body.M * (alpha.cross(r) + omega.cross(omega.cross(r))) - body.force;
}

void addReaction(const Pivot& pivot, RigidBody& body) {
  applyForce(body, body.R * pivot.c_B + body.x, reaction(pivot, body));
}

}  // namespace tumble
