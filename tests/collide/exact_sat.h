// The separating-axis test of two boxes in exact arithmetic: oracle for the rounded one.
#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "sim/math/vec.h"
#include "sim/shape/shape.h"

namespace tumble {

using Exact = boost::multiprecision::cpp_int;
using ExactVec = std::array<Exact, 3>;
using Wide = boost::multiprecision::cpp_bin_float_50;

/// Every number is an integer in units of 2⁻²⁵⁶, so a double above 2⁻²⁰³ in size enters exactly.
inline constexpr int kUnit = 256;

inline Exact exactly(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  const Exact whole = static_cast<long long>(std::ldexp(mantissa, 53));
  const int shift = exponent - 53 + kUnit;
  if (x != 0.0 && shift < 0) throw std::range_error("too small to be exact");
  return x == 0.0 ? Exact(0) : Exact(whole << shift);
}
inline Exact dot(const ExactVec& a, const ExactVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline ExactVec cross(const ExactVec& a, const ExactVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// An oriented box with exactly orthogonal axes |q|² R(q), which need not be unit.
struct ExactBox {
  std::array<ExactVec, 3> axis;
  Exact length;  ///< |q|², of every axis
  ExactVec half, x;

  ExactBox(const Box& box, const Pose& pose) {
    const Exact w = exactly(pose.q.w()), p = exactly(pose.q.x());
    const Exact q = exactly(pose.q.y()), r = exactly(pose.q.z());
    length = w * w + p * p + q * q + r * r;
    axis[0] = {w * w + p * p - q * q - r * r, 2 * (p * q + w * r), 2 * (p * r - w * q)};
    axis[1] = {2 * (p * q - w * r), w * w - p * p + q * q - r * r, 2 * (q * r + w * p)};
    axis[2] = {2 * (p * r + w * q), 2 * (q * r - w * p), w * w - p * p - q * q + r * r};
    for (int k = 0; k < 3; ++k) {
      half[k] = exactly(box.half[k]);
      x[k] = exactly(pose.x[k]);
    }
  }
};

struct ExactBoxes {
  ExactBox a, b;
  ExactVec d;

  ExactBoxes(const Box& boxA, const Pose& poseA, const Box& boxB, const Pose& poseB)
      : a(boxA, poseA), b(boxB, poseB) {
    for (int k = 0; k < 3; ++k) d[k] = a.x[k] - b.x[k];
  }

  /// gap(n) |n| |qa|² |qb|² for any n.
  Exact scaledGap(const ExactVec& n) const {
    Exact reachA = 0, reachB = 0;
    for (int k = 0; k < 3; ++k) {
      reachA += a.half[k] * abs(dot(n, a.axis[k]));
      reachB += b.half[k] * abs(dot(n, b.axis[k]));
    }
    return abs(dot(n, d)) * a.length * b.length - reachA * b.length - reachB * a.length;
  }

  /// gap(n) [m], rounded once at the end.
  double gap(const ExactVec& n) const {
    const Wide unit = ldexp(Wide(1), kUnit);
    const Wide length = sqrt(Wide(dot(n, n))) * Wide(a.length) * Wide(b.length) * unit;
    return (Wide(scaledGap(n)) / length).convert_to<double>();
  }

  template <class Visit>
  void visitFaces(Visit visit) const {
    for (int i = 0; i < 3; ++i) {
      visit(a.axis[i]);
      visit(b.axis[i]);
    }
  }
  template <class Visit>
  void visitAll(Visit visit) const {
    visitFaces(visit);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const ExactVec n = cross(a.axis[i], b.axis[j]);
        if (dot(n, n) != 0) visit(n);
      }
    }
  }

  /// Sign of the widest gap: +1 apart, 0 touching, −1 overlapping.
  int sign() const {
    int widest = -1;
    visitAll([&](const ExactVec& n) { widest = std::max(widest, scaledGap(n).sign()); });
    return widest;
  }
  /// Widest gap [m] over the faces alone, and over all 15 directions.
  double widestFace() const {
    double widest = -1e300;
    visitFaces([&](const ExactVec& n) { widest = std::max(widest, gap(n)); });
    return widest;
  }
  double widest() const {
    double widest = -1e300;
    visitAll([&](const ExactVec& n) { widest = std::max(widest, gap(n)); });
    return widest;
  }
};

}  // namespace tumble
