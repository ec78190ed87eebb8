#include "sim/flight/flight.h"

#include <cmath>
#include <limits>

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

}  // namespace

Quat SymmetricRotor::attitude(double t) const {
  return rotated(q0 * rotated(Quat::Identity(), t * spin_B), t * precession);
}

Vec3 SymmetricRotor::omega(double t) const {
  return precession + attitude(t) * spin_B;
}

std::optional<Flight> symmetricFlight(const RigidBody& body, const Vec3& gravity) {
  if (body.fixed()) {
    return Flight{{body.x, body.v, Vec3::Zero()}, {body.q, body.omega, Vec3::Zero()}};
  }
  const int axis = symmetryAxis(body.Ibody);
  if (axis < 0) return std::nullopt;

  const double across = body.Ibody((axis + 1) % 3, (axis + 1) % 3);
  const double along = body.Ibody(axis, axis);
  Vec3 spin_B = Vec3::Zero();
  spin_B[axis] = (1.0 / along - 1.0 / across) * body.R.col(axis).dot(body.L);
  return Flight{{body.x, body.v, gravity}, {body.q, body.L / across, spin_B}};
}

}  // namespace tumble
