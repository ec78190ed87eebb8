#include "sim/audit/recorded.h"

#include <algorithm>
#include <cmath>

#include "sim/math/rotation.h"

namespace tumble {
namespace {

/// The world vector about which q0 has turned to q1 by its length [rad], at most π.
Vec3 turnFrom(const Quat& q0, const Quat& q1) {
  Quat d = q1 * q0.conjugate();
  if (d.w() < 0.0) d.coeffs() = -d.coeffs();
  const double sine = d.vec().norm();
  return sine > 0.0 ? Vec3((2.0 * std::atan2(sine, d.w()) / sine) * d.vec()) : Vec3(2.0 * d.vec());
}

/// φ̇ of the rotation vector φ that turns with ω.
Vec3 rateOfTurn(const Vec3& phi, const Vec3& omega) {
  const double s = phi.squaredNorm();
  const double c = 1.0 / 12.0 + s * (1.0 / 720.0 + s * (1.0 / 30240.0 + s / 1209600.0));
  return omega - 0.5 * phi.cross(omega) + c * phi.cross(phi.cross(omega));
}

/// ω of a rotation vector φ that changes at the rate φ̇.
Vec3 spinOfTurn(const Vec3& phi, const Vec3& rate) {
  const double s = phi.squaredNorm();
  const double a = 1.0 / 2.0 - s * (1.0 / 24.0 - s * (1.0 / 720.0 - s / 40320.0));
  const double b = 1.0 / 6.0 - s * (1.0 / 120.0 - s * (1.0 / 5040.0 - s / 362880.0));
  return rate + a * phi.cross(rate) + b * phi.cross(phi.cross(rate));
}

/// The rate at the start, times h, unless it does not agree with the way: then that of the parabola
/// which meets the end.
Vec3 agreeing(const Vec3& way, const Vec3& first, const Vec3& last) {
  constexpr double kSmooth = 0.1;  // of the change of the rate, what is left for forces that change
  const Vec3 off = 2.0 * way - first - last;
  return off.norm() <= kSmooth * (last - first).norm() ? first : Vec3(2.0 * way - last);
}

/// Of the cubic with these ends and rates, the value and its rate at a share of the way.
void cubic(double s, const Vec3& way, const Vec3& first, const Vec3& last, Vec3& value,
           Vec3& rate) {
  const double p = s * s * (3.0 - 2.0 * s), m0 = s * (1.0 - s) * (1.0 - s), m1 = s * s * (s - 1.0);
  value = p * way + m0 * first + m1 * last;
  rate =
      6.0 * s * (1.0 - s) * way + (1.0 - s) * (1.0 - 3.0 * s) * first + s * (3.0 * s - 2.0) * last;
}

}  // namespace

Vec3 spinOf(const RigidBody& constants, const Recorded& r) {
  if (constants.particle) return Vec3::Zero();
  if (constants.fixed()) return constants.omega;
  return r.q * (constants.IbodyInv * (r.q.conjugate() * r.L));
}

double kineticOf(const RigidBody& constants, const Recorded& r) {
  const double along = 0.5 * constants.invM * r.P.squaredNorm();
  if (constants.particle || r.L.isZero(0.0)) return along;
  const Vec3 L_B = r.q.conjugate() * r.L;
  return along + 0.5 * L_B.dot(constants.IbodyInv * L_B);
}

BodyPath::BodyPath(const RigidBody& constants, const Recorded& start, const Recorded& end, double h,
                   bool struck)
    : x0_(start.x),
      way_(end.x - start.x),
      u0_(h * constants.invM * start.P),
      u1_(h * constants.invM * end.P),
      q0_(start.q),
      turn_(turnFrom(start.q, end.q)),
      w0_(h * spinOf(constants, start)),
      w1_(h * spinOf(constants, end)),
      h_(h) {
  constexpr double kLost = 1.0;  // [rad]
  lost_ = std::max(w0_.norm(), w1_.norm()) > kLost || turn_.norm() > kLost;
  if (struck) u0_ = agreeing(way_, u0_, u1_);
  if (lost_) return;
  w1_ = rateOfTurn(turn_, w1_);
  if (struck) w0_ = agreeing(turn_, w0_, w1_);
}

BodyPath::BodyPath(const RigidBody& fixed, double h)
    : x0_(fixed.x),
      way_(h * fixed.v),
      u0_(way_),
      u1_(way_),
      q0_(fixed.q),
      turn_(h * fixed.omega),
      w0_(turn_),
      w1_(turn_),
      h_(h) {}

double BodyPath::error(double share, double r) const {
  constexpr double kFourth = 2.0;  // of the third term: the fourth at most
  const double bend = 0.5 * (w1_ - w0_).norm(), fastest = std::max(w0_.norm(), w1_.norm());
  const double square = fastest * fastest + 4.0 * bend;
  const auto fourth = [&](const Vec3& way, const Vec3& first, const Vec3& last) {
    const double second = 0.5 * (last - first).norm(), third = (first + last - 2.0 * way).norm();
    return std::max(kFourth * third, second * square / 6.0);
  };
  const double part = share * (1.0 - share);
  return part * part * (fourth(way_, u0_, u1_) + r * fourth(turn_, w0_, w1_));
}

PathPoint BodyPath::at(double share) const {
  PathPoint point;
  Vec3 offset, rate, phi, phiRate;
  cubic(share, way_, u0_, u1_, offset, rate);
  cubic(share, turn_, w0_, w1_, phi, phiRate);
  point.x = x0_ + offset;
  point.v = rate / h_;
  point.q = rotated(q0_, phi);
  point.omega = spinOfTurn(phi, phiRate) / h_;
  return point;
}

}  // namespace tumble
