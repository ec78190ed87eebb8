// Chapter 6, problem: numbers in two lanes that the processor works on side by side. Every
// operation is one of IEEE arithmetic per lane, in the order written.
#pragma once

#include <cmath>

#include "sim/math/vec.h"

namespace tumble {

using Lanes [[gnu::vector_size(16)]] = double;
using LaneMask [[gnu::vector_size(16)]] = long long;  ///< per lane: −1 where a comparison holds

/// Three components, each in two lanes.
struct Lanes3 {
  Lanes x, y, z;
};

/// A symmetric 3×3 matrix in each lane.
struct LanesSymmetric {
  Lanes xx, xy, xz, yy, yz, zz;
};

inline Vec3 laneOf(const Lanes3& a, int lane) {
  return {a.x[lane], a.y[lane], a.z[lane]};
}
inline void setLane(Lanes3& a, int lane, const Vec3& to) {
  a.x[lane] = to[0];
  a.y[lane] = to[1];
  a.z[lane] = to[2];
}
inline Mat3 laneOf(const LanesSymmetric& A, int lane) {
  Mat3 B;
  B << A.xx[lane], A.xy[lane], A.xz[lane], A.xy[lane], A.yy[lane], A.yz[lane], A.xz[lane],
      A.yz[lane], A.zz[lane];
  return B;
}
inline void setLane(LanesSymmetric& A, int lane, const Mat3& to) {
  A.xx[lane] = to(0, 0);
  A.xy[lane] = to(0, 1);
  A.xz[lane] = to(0, 2);
  A.yy[lane] = to(1, 1);
  A.yz[lane] = to(1, 2);
  A.zz[lane] = to(2, 2);
}

/// One lane into three numbers.
inline void setNumbers(double* to, const Lanes3& a, int lane) {
  to[0] = a.x[lane];
  to[1] = a.y[lane];
  to[2] = a.z[lane];
}

/// Three numbers into either lane.
inline Lanes3 abreast(const double* one, const double* other) {
  return {Lanes{one[0], other[0]}, Lanes{one[1], other[1]}, Lanes{one[2], other[2]}};
}

inline Lanes3 operator+(const Lanes3& a, const Lanes3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Lanes3 operator-(const Lanes3& a) {
  return {-a.x, -a.y, -a.z};
}
inline Lanes3 operator*(const Lanes3& a, const Lanes3& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline Lanes3 operator*(const Lanes3& a, Lanes b) {
  return {a.x * b, a.y * b, a.z * b};
}
inline Lanes3 operator*(const Lanes3& a, double b) {
  return {a.x * b, a.y * b, a.z * b};
}
/// A b, the third row summed from its end: as Eigen does it.
inline Lanes3 operator*(const LanesSymmetric& A, const Lanes3& b) {
  return {A.xx * b.x + A.xy * b.y + A.xz * b.z, A.xy * b.x + A.yy * b.y + A.yz * b.z,
          A.xz * b.x + (A.yz * b.y + A.zz * b.z)};
}

inline double sum(Lanes a) {
  return a[0] + a[1];
}
inline Lanes root(Lanes a) {
  return Lanes{std::sqrt(a[0]), std::sqrt(a[1])};
}
inline bool both(LaneMask mask) {
  return (mask[0] & mask[1]) != 0;
}
inline bool neither(LaneMask mask) {
  return (mask[0] | mask[1]) == 0;
}

/// Per lane a where the mask holds, else b.
inline Lanes chosen(LaneMask mask, Lanes a, Lanes b) {
  return mask ? a : b;
}
inline Lanes3 chosen(LaneMask mask, const Lanes3& a, const Lanes3& b) {
  return {chosen(mask, a.x, b.x), chosen(mask, a.y, b.y), chosen(mask, a.z, b.z)};
}

inline Lanes larger(Lanes a, Lanes b) {
  return a > b ? a : b;
}
inline Lanes sizeOf(Lanes a) {
  return larger(a, -a);
}
inline Lanes sizeOf(const Lanes3& a) {
  return larger(larger(sizeOf(a.x), sizeOf(a.y)), sizeOf(a.z));
}

}  // namespace tumble
