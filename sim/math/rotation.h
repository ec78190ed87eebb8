// Chapter 0, math: rotations, and sines that are the same on every machine.
#pragma once

#include "sim/math/vec.h"

namespace tumble {

/// The matrix a* with  a* b = a × b  (slide SD18).
Mat3 skew(const Vec3& a);

/// Sine and cosine of x [rad], to within 1 unit in the last place for |x| ≤ 2e8, made of additions,
/// multiplications and `floor` alone, so that every compiler and library gives the same bits.
/// NaN beyond that range.
void sinCos(double x, double& s, double& c);

/// The rotation by an angle [rad] about an axis of any length but zero, right-handed.
/// @throws std::invalid_argument if the axis is zero or not finite.
Quat fromAxisAngle(const Vec3& axis, double radians);

/// The least rotation that takes the direction of `from` to that of `to`; where they are opposite,
/// about any axis across them. Both of any length but zero and infinity.
///   q = (1 + a·b, a × b) / |…|  for the unit vectors a, b
Quat turnBetween(const Vec3& from, const Vec3& to);

/// exp(w) q: the orientation q, turned about the world vector w by |w| [rad]. Exact for a constant
/// angular velocity:  q(t + h) = rotated(q(t), h ω).
///   exp(w) = (cos(|w|/2), sin(|w|/2) w/|w|)
Quat rotated(const Quat& q, const Vec3& w);

/// The inverse: w, |w| ≤ π, with  exp(w) = ±q  for a unit quaternion.
Vec3 turnVector(const Quat& q);

/// Rotation matrix of a quaternion of any length but zero; the same for q and for 2q, so that the
/// stages of an integrator, where q is only nearly of unit length, still see a rotation.
Mat3 rotationMatrix(const Quat& q);

/// The rotation Q nearest to a matrix of positive determinant: that of its polar decomposition
/// R = S Q, by Newton's iteration  Q ← ½ (Q + Q⁻ᵀ)  from Q = R (Higham, Computing the Polar
/// Decomposition, 1986).
/// @return a unit quaternion; NaN if R has no positive determinant.
Quat nearestRotation(const Mat3& R);

}  // namespace tumble
