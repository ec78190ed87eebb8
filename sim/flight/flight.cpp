#include "sim/flight/flight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/math/rotation.h"

namespace tumble {
namespace {

bool equalToRounding(double a, double b) {
  return std::abs(a - b) <= 4.0 * std::numeric_limits<double>::epsilon() * std::abs(a + b);
}

/// The body axis about which the body is symmetric, or −1.
int symmetryAxis(const Mat3& I) {
  if (!I.isDiagonal(0.0)) return -1;
  for (int axis = 0; axis < 3; ++axis) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    if (equalToRounding(I(i, i), I(j, j))) return axis;
  }
  return -1;
}

SymmetricRotor rotorOf(const RigidBody& body) {
  if (body.fixed()) return {body.q, body.omega, Vec3::Zero()};
  const int axis = symmetryAxis(body.Ibody);
  if (axis < 0) throw std::invalid_argument("flight: three unlike principal moments");
  const double across = body.Ibody((axis + 1) % 3, (axis + 1) % 3);
  const double along = body.Ibody(axis, axis);
  Vec3 spin_B = Vec3::Zero();
  spin_B[axis] = (1.0 / along - 1.0 / across) * body.R.col(axis).dot(body.L);
  return {body.q, body.L / across, spin_B};
}

}  // namespace

Quat SymmetricRotor::attitude(double t) const {
  return rotated(q0 * rotated(Quat::Identity(), t * spin_B), t * precession);
}

Vec3 SymmetricRotor::omega(double t) const {
  return precession + attitude(t) * spin_B;
}

Flight::Flight(const RigidBody& start, const Vec3& acceleration, double t0)
    : t0_(t0),
      parabola_{start.x, start.v, start.fixed() ? Vec3(Vec3::Zero()) : acceleration},
      rotor_(rotorOf(start)),
      P0_(start.P),
      force_(start.fixed() ? Vec3(Vec3::Zero()) : Vec3(start.M * acceleration)),
      L_(start.L) {
  // ω turns about L at the rate of precession:  ω̇ = precession × ω.
  turning_ = start.omega.squaredNorm() + rotor_.precession.cross(start.omega).norm();
}

void Flight::at(double t, RigidBody& body) const {
  const Pose now = pose(t);
  body.x = now.x;
  body.q = now.q;
  body.P = P0_ + (t - t0_) * force_;
  body.L = L_;
  updateDerived(body);
}

Pose Flight::pose(double t) const {
  return {parabola_.position(t - t0_), rotor_.attitude(t - t0_)};
}

double Flight::accelBound(double r) const {
  // The last factor covers rounding.
  return (parabola_.g.norm() + r * turning_) * (1.0 + 1e-12);
}

}  // namespace tumble
