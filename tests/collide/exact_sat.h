// The separating-axis test of two boxes in exact rational arithmetic: oracle for its rounded one.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "sim/math/vec.h"
#include "sim/shape/shape.h"

namespace tumble {

using Rational = boost::multiprecision::cpp_rational;
using RVec = std::array<Rational, 3>;

inline Rational dot(const RVec& a, const RVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline RVec cross(const RVec& a, const RVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Exactly orthogonal axes of the exact quaternion: R(q)/|q|², columns first.
inline std::array<RVec, 3> exactAxes(const Quat& q) {
  const Rational w(q.w()), x(q.x()), y(q.y()), z(q.z());
  const Rational n = w * w + x * x + y * y + z * z;
  return {
      {{(w * w + x * x - y * y - z * z) / n, 2 * (x * y + w * z) / n, 2 * (x * z - w * y) / n},
       {2 * (x * y - w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z + w * x) / n},
       {2 * (x * z + w * y) / n, 2 * (y * z - w * x) / n, (w * w - x * x - y * y + z * z) / n}}};
}

/// gap(n) |n| for any n, exactly.
struct ExactBoxes {
  std::array<RVec, 3> A, B;
  RVec halfA, halfB, d;

  ExactBoxes(const Box& a, const Pose& poseA, const Box& b, const Pose& poseB)
      : A(exactAxes(poseA.q)), B(exactAxes(poseB.q)) {
    for (int k = 0; k < 3; ++k) {
      halfA[k] = Rational(a.half[k]);
      halfB[k] = Rational(b.half[k]);
      d[k] = Rational(poseA.x[k]) - Rational(poseB.x[k]);
    }
  }

  Rational gap(const RVec& n) const {
    Rational g = abs(dot(n, d));
    for (int k = 0; k < 3; ++k) {
      g -= halfA[k] * abs(dot(n, A[k]));
      g -= halfB[k] * abs(dot(n, B[k]));
    }
    return g;
  }

  /// Sign of the widest gap: +1 apart, 0 touching, −1 overlapping.
  int sign() const {
    int best = -1;
    for (int i = 0; i < 3; ++i) {
      best = std::max({best, gap(A[i]).sign(), gap(B[i]).sign()});
      for (int j = 0; j < 3; ++j) {
        const RVec n = cross(A[i], B[j]);
        if (dot(n, n) != 0) best = std::max(best, gap(n).sign());
      }
    }
    return best;
  }

  /// Widest gap over the faces, and over all 15 directions, rounded once at the end. [m]
  double widestFace() const {
    Rational best = gap(A[0]);
    for (int i = 0; i < 3; ++i) {
      best = std::max(best, gap(A[i]));
      best = std::max(best, gap(B[i]));
    }
    return best.convert_to<double>();
  }
  double widest() const {
    double best = widestFace();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const RVec n = cross(A[i], B[j]);
        const Rational n2 = dot(n, n);
        if (n2 == 0) continue;
        best = std::max(best, gap(n).convert_to<double>() / std::sqrt(n2.convert_to<double>()));
      }
    }
    return best;
  }
};

}  // namespace tumble
