// What nothing touches: closed forms, and driven groups by their equation of motion.
#include <algorithm>
#include <cmath>

#include "sim/math/rotation.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {
namespace {

/// Whether a body turns alike about all axes, so that ω is constant.
bool isRound(const Mat3& I) {
  return I(0, 0) == I(1, 1) && I(1, 1) == I(2, 2) && I.isDiagonal(0.0);
}

}  // namespace

void Stepping::coast(int i, double h) {
  RigidBody& body = state_.bodies[i];
  const Vec3 before = work_.before[i].head<3>();
  const int drag = memory_.drives->dragOf[i];
  if (drag < 0) {
    body.x += 0.5 * h * (before + body.v);  // the parabola
    if (body.torque.isZero(0.0)) return spin(i, h);
    return turn(body, body.L - 0.5 * h * body.torque, h);
  }

  // Velocities decay to what the other forces hold up; these do work along the way.
  const DragStep& step = work_.drags[drag];
  const Drag& law = memory_.drives->drags[drag];
  const Vec3 force = body.force + law.linear * before;
  const Vec3 way = h * step.way.mean * before + h * h * step.way.lag * body.invM * force;
  const Vec3 steady = force - body.M * model_.def.gravity;
  body.x += way;
  double& work = report_.certificate.work_of_forces;
  work += 0.5 * body.M * (body.v - before).dot(body.v + before) - force.dot(way);
  work += steady.dot(way - 0.5 * h * (before + body.v));
  if (body.particle) return;
  const Vec3 omega = work_.before[i].tail<3>();
  const double turning = 0.5 * body.L.dot(body.omega);
  if (law.angular == 0.0 && body.torque.isZero(0.0)) return spin(i, h);
  if (isRound(body.Ibody)) {
    body.q = rotated(body.q, h * decay(h * law.angular * law.inverse[0]).mean * omega);
    updateDerived(body);
    work += turning - 0.5 * omega.dot(body.Ibody * omega);
    return;
  }
  // Half of the decay, the free turn, the other half (Strang); the turn by the mean of what decays,
  // which about a principal axis is where it comes to, however soon it stops.
  const Mat3 I = body.R * body.Ibody * body.R.transpose();
  const double turningBefore = 0.5 * omega.dot(I * omega);
  const Vec3 half = I * (step.halfLeft * omega);
  body.L = I * (step.Iinv * (I * omega));
  updateVelocities(body);
  spin(i, h);
  body.L = half;
  updateDerived(body);
  body.L =
      body.R * body.Ibody * body.R.transpose() * (dragStep(law, body, h).halfLeft * body.omega);
  updateVelocities(body);
  work += 0.5 * body.L.dot(body.omega) - turningBefore;
}

/// In closed form from the instant on at which it came free.
void Stepping::spin(int i, double h) {
  RigidBody& body = state_.bodies[i];
  if (body.particle || body.L.isZero(0.0)) return body.q.normalize();
  if (isRound(body.Ibody)) {
    body.q = rotated(body.q, h * body.omega);
    return;
  }
  FreeSpin& free = memory_.spins[i];
  if (!free.rotor || free.q.coeffs() != body.q.coeffs() || free.L != body.L) {
    free.rotor.emplace(body.Ibody, body.q, body.L);
    free.L = body.L;
    free.spent = 0.0;
  }
  free.spent += h;
  body.q = free.rotor->attitude(free.spent).normalized();
  free.q = body.q;
}

void Stepping::flyGroups(double h) {
  if (!tiesRun()) return;
  for (DrivenGroup& group : memory_.drives->groups) {
    if (group.bound) continue;
    const auto refresh = [&](auto give) {
      for (std::size_t k = 0; k < group.bodies.size(); ++k)
        give(state_.bodies[group.bodies[k]], group.moved[k]);
    };
    refresh([](RigidBody& of, RigidBody& copy) { copy = of; });
    group.system->pack(group.moved, group.y);
    group.stepper->step(*group.system, state_.t, h, group.y);
    group.system->unpack(group.y, group.moved);
    refresh([](RigidBody& of, RigidBody& copy) {
      if (!of.fixed()) of = copy;
    });
    const double* ledger = &group.y[group.y.size() - DrivenSystem::kLedger];
    report_.certificate.work_of_forces += ledger[0];
    state_.externalImpulse += Vec3(ledger[1], ledger[2], ledger[3]);
  }
}

}  // namespace tumble
