#include "sim/math/rotation.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tumble {
namespace {

// π/2 in four parts; a multiple k of each of the first three is exact for |k| < 2²⁷.
constexpr double kHalfPi[] = {0x1.921fb5p+0, 0x1.110b46p-26, 0x1.1a6263p-54, 0x1.8a2e03707344ap-81};
constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
constexpr double kLargest = 2e8;

/// x − k π/2 as an unevaluated sum hi + lo, |hi| ≤ π/4 up to rounding.
struct Reduced {
  double hi, lo, k;
};

Reduced reduce(double x) {
  const double k = std::floor(x * kTwoOverPi + 0.5);
  double hi = x, lo = 0.0;
  for (const double part : kHalfPi) {
    // Two-sum (Knuth): sum + rest = hi + term without error.
    const double term = -k * part;
    const double sum = hi + term;
    const double share = sum - hi;
    const double rest = (hi - (sum - share)) + (term - share);
    hi = sum;
    lo += rest;
  }
  const double sum = hi + lo;
  return {sum, lo - (sum - hi), k};
}

/// sin(hi + lo) by Taylor's series to hi¹⁷; what is cut off is below 1e-19.
double sinSeries(double hi, double lo) {
  const double z = hi * hi;
  double p = 1.0 / 355687428096000.0;  // 1/17!
  p = p * z - 1.0 / 1307674368000.0;   // 1/15!
  p = p * z + 1.0 / 6227020800.0;      // 1/13!
  p = p * z - 1.0 / 39916800.0;        // 1/11!
  p = p * z + 1.0 / 362880.0;          // 1/9!
  p = p * z - 1.0 / 5040.0;            // 1/7!
  p = p * z + 1.0 / 120.0;             // 1/5!
  p = p * z - 1.0 / 6.0;               // 1/3!
  return hi + (hi * z * p + lo * (1.0 - 0.5 * z));
}

/// cos(hi + lo) by Taylor's series to hi¹⁶; what is cut off is below 2e-18.
double cosSeries(double hi, double lo) {
  const double z = hi * hi;
  double p = 1.0 / 20922789888000.0;  // 1/16!
  p = p * z - 1.0 / 87178291200.0;    // 1/14!
  p = p * z + 1.0 / 479001600.0;      // 1/12!
  p = p * z - 1.0 / 3628800.0;        // 1/10!
  p = p * z + 1.0 / 40320.0;          // 1/8!
  p = p * z - 1.0 / 720.0;            // 1/6!
  p = p * z + 1.0 / 24.0;             // 1/4!
  // 1 − z/2 is the largest sum: keep what its rounding drops.
  const double half = 0.5 * z;
  const double head = 1.0 - half;
  return head + (((1.0 - head) - half) + (z * z * p - hi * lo));
}

}  // namespace

Mat3 skew(const Vec3& a) {
  Mat3 m;
  m << 0.0, -a.z(), a.y(),  //
      a.z(), 0.0, -a.x(),   //
      -a.y(), a.x(), 0.0;
  return m;
}

void sinCos(double x, double& s, double& c) {
  if (!(std::abs(x) <= kLargest)) {
    s = c = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  const Reduced r = reduce(x);
  const double sine = sinSeries(r.hi, r.lo), cosine = cosSeries(r.hi, r.lo);

  // Each quarter turn takes (cos, sin) to (−sin, cos).
  switch (static_cast<int>(r.k) & 3) {
    case 0:
      s = sine, c = cosine;
      break;
    case 1:
      s = cosine, c = -sine;
      break;
    case 2:
      s = -sine, c = -cosine;
      break;
    default:
      s = -cosine, c = sine;
      break;
  }
}

Quat fromAxisAngle(const Vec3& axis, double radians) {
  const Vec3 unit = axis.stableNormalized();
  if (!unit.allFinite() || unit.isZero(0.0)) {
    throw std::invalid_argument("axis of a rotation: must be finite and not zero");
  }
  double s, c;
  sinCos(0.5 * radians, s, c);
  return Quat(c, s * unit.x(), s * unit.y(), s * unit.z());
}

Quat turnBetween(const Vec3& from, const Vec3& to) {
  const Vec3 a = from.stableNormalized(), b = to.stableNormalized();
  const auto acute = [](const Vec3& u, const Vec3& v) {
    const Vec3 axis = u.cross(v);
    return Quat(1.0 + u.dot(v), axis.x(), axis.y(), axis.z()).normalized();
  };
  if (a.dot(b) >= 0.0) return acute(a, b);
  // Half a turn takes a to −a, from where the way is short. Its axis is cleared of what is along a.
  Vec3 across = a.cross(b);
  across -= a * a.dot(across);
  const double size = across.norm();
  across = size > 0.0 ? Vec3(across / size) : a.unitOrthogonal();
  return acute(-a, b) * Quat(0.0, across.x(), across.y(), across.z());
}

[[gnu::flatten]] Quat rotated(const Quat& q, const Vec3& w) {
  const double angle2 = w.squaredNorm();
  constexpr double kSmall = 1e-8;  // [rad²]
  double scale, c;                 // sin(|w|/2)/|w| and cos(|w|/2)
  if (angle2 < kSmall) {
    // The next terms of the series, |w|⁴/3840 and −|w|⁶/46080, are below rounding.
    scale = 0.5 - angle2 / 48.0;
    c = 1.0 - angle2 / 8.0 + angle2 * angle2 / 384.0;
  } else {
    const double angle = std::sqrt(angle2);
    double s;
    sinCos(0.5 * angle, s, c);
    scale = s / angle;
  }
  return Quat(c, scale * w.x(), scale * w.y(), scale * w.z()) * q;
}

[[gnu::flatten]] Vec3 turnVector(const Quat& q) {
  const double sine = q.vec().norm(), sign = q.w() < 0.0 ? -1.0 : 1.0;
  const double scale = sine > 0.0 ? 2.0 * std::atan2(sine, sign * q.w()) / sine : 2.0;
  return sign * scale * q.vec();
}

Mat3 rotationMatrix(const Quat& q) {
  const double s = 2.0 / q.squaredNorm();
  const double w = q.w(), x = q.x(), y = q.y(), z = q.z();
  Mat3 R;
  R << 1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
      s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x),   //
      s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y);
  return R;
}

Quat nearestRotation(const Mat3& R) {
  constexpr int kMost = 60;  // a matrix 2³⁰ times too long takes 30 halvings and then a few
  Mat3 Q = R;
  if (!(Q.determinant() > 0.0)) Q.setConstant(std::numeric_limits<double>::quiet_NaN());
  for (int i = 0; i < kMost; ++i) {
    const Mat3 next = 0.5 * (Q + Q.inverse().transpose());
    const double change = (next - Q).norm();
    Q = next;
    constexpr double kChange = 1e-15;  // rounding of a matrix
    if (!(change > kChange)) break;
  }
  return Quat(Q).normalized();
}

}  // namespace tumble
