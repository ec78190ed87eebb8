#include "sim/flight/flight.h"

namespace tumble {
namespace {

Vec3 unlessFixed(const RigidBody& body, const Vec3& a) {
  return body.fixed() ? Vec3(Vec3::Zero()) : a;
}

}  // namespace

Flight::Flight(const RigidBody& start, const Vec3& acceleration, double t0)
    : t0_(t0),
      parabola_{start.x, start.v, unlessFixed(start, acceleration)},
      P0_(start.P),
      force_(unlessFixed(start, start.M * acceleration)),
      L_(start.L),
      q0_(start.q) {
  // A fixed body turns steadily, a particle not at all.
  if (start.fixed()) {
    rotor_ = Rotor(start.q, start.omega);
  } else if (start.particle) {
    rotor_ = Rotor(start.q, Vec3::Zero());
  } else {
    rotor_ = Rotor(start.Ibody, start.q, start.L);
  }
}

void Flight::at(double t, RigidBody& body) const {
  // What does not turn has only a place and a velocity.
  const bool asBefore = turning() == 0.0 && body.q.coeffs() == q0_.coeffs();
  if (!asBefore) body.q = attitude(t);
  body.x = parabola_.position(t - t0_);
  body.P = P0_ + (t - t0_) * force_;
  body.L = L_;
  if (!asBefore) return updateDerived(body);
  if (!body.fixed()) body.v = body.invM * body.P, body.omega = body.Iinv * body.L;
}

Pose Flight::pose(double t) const {
  return {parabola_.position(t - t0_), attitude(t)};
}

Quat Flight::attitude(double t) const {
  return turning() == 0.0 ? q0_ : rotor_.attitude(t - t0_);
}

double Flight::accelBound(double r) const {
  constexpr double kWider = 1e-12;
  return (parabola_.g.norm() + r * rotor_.turning()) * (1.0 + kWider);
}

}  // namespace tumble
