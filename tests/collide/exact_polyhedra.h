// Whether two convex polyhedra overlap, in exact integers: every face and every pair of edges is
// tried. Long doubles see first which axes could matter.
#pragma once

#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "sim/collide/core.h"
#include "sim/shape/shape.h"

namespace tumble::exact {

using Integer = boost::multiprecision::mpz_int;

template <class T>
using V = std::array<T, 3>;
template <class T>
T dot(const V<T>& a, const V<T>& b) {
  return T(a[0] * b[0]) + T(a[1] * b[1]) + T(a[2] * b[2]);
}
template <class T>
V<T> cross(const V<T>& a, const V<T>& b) {
  return {T(a[1] * b[2] - a[2] * b[1]), T(a[2] * b[0] - a[0] * b[2]), T(a[0] * b[1] - a[1] * b[0])};
}
template <class T>
V<T> minus(const V<T>& a, const V<T>& b) {
  return {T(a[0] - b[0]), T(a[1] - b[1]), T(a[2] - b[2])};
}

/// Integers count in units of 2⁻¹⁶⁰: a double above 2⁻¹⁰⁷ in size, or zero, enters exactly.
inline void enter(double x, Integer& out) {
  constexpr int kUnit = 160;
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  out = static_cast<long>(std::ldexp(mantissa, 53));
  const int shift = exponent - 53 + kUnit;
  if (x == 0.0) return;
  if (shift < 0) throw std::range_error("too small to be exact");
  out <<= shift;
}
inline void enter(double x, long double& out) {
  out = x;
}
template <class T>
V<T> entered(const Vec3& v) {
  V<T> out;
  for (int k = 0; k < 3; ++k) enter(v[k], out[k]);
  return out;
}

/// What is tried of a solid: all points, one face and edge of each direction.
struct Outline {
  std::vector<Vec3> points;  // [m] from `origin`
  Vec3 origin = Vec3::Zero();
  std::vector<std::array<int, 3>> faces;
  std::vector<std::array<int, 2>> edges;
};

inline Outline outlineOf(const Shape& shape) {
  Outline out;
  if (const Box* box = std::get_if<Box>(&shape)) {
    for (const Vec3& p : convex::unitCube().points) out.points.push_back(p.cwiseProduct(box->half));
    out.faces = {{0, 4, 2}, {1, 3, 5}, {0, 1, 4}, {2, 6, 3}, {0, 2, 1}, {4, 5, 6}};
    out.edges = {{0, 1}, {0, 2}, {0, 4}};
    return out;
  }
  const Hull& hull = std::get<Hull>(shape);
  out.points = hull.solid->points;
  out.origin = hull.origin;
  for (const auto& face : hull.solid->faces) out.faces.push_back({face[0], face[1], face[2]});
  for (const auto& e : hull.solid->edges) out.edges.push_back({e.from, e.to});
  return out;
}

/// The points of both solids, scaled by |qa|²|qb|², with exactly orthogonal axes.
template <class T>
struct Placed {
  std::vector<V<T>> a, b;
};

template <class T>
T turned(const Outline& solid, const Quat& q, std::vector<V<T>>& out) {
  T w, x, y, z;
  enter(q.w(), w), enter(q.x(), x), enter(q.y(), y), enter(q.z(), z);
  const T ww = w * w, xx = x * x, yy = y * y, zz = z * z;
  const V<T> m[3] = {{T(ww + xx - yy - zz), T(2 * (x * y - w * z)), T(2 * (x * z + w * y))},
                     {T(2 * (x * y + w * z)), T(ww - xx + yy - zz), T(2 * (y * z - w * x))},
                     {T(2 * (x * z - w * y)), T(2 * (y * z + w * x)), T(ww - xx - yy + zz)}};
  const V<T> origin = entered<T>(solid.origin);
  for (const Vec3& point : solid.points) {
    const V<T> p = minus(entered<T>(point), origin);
    out.push_back({dot(m[0], p), dot(m[1], p), dot(m[2], p)});
  }
  return T(ww + xx) + T(yy + zz);
}

template <class T>
Placed<T> placed(const Outline& a, const Pose& poseA, const Outline& b, const Pose& poseB) {
  Placed<T> out;
  const T squareA = turned(a, poseA.q, out.a), squareB = turned(b, poseB.q, out.b);
  const V<T> d = minus(entered<T>(poseA.x), entered<T>(poseB.x));
  for (V<T>& p : out.a)
    for (int k = 0; k < 3; ++k) p[k] = T(p[k] + T(squareA * d[k])) * squareB;
  for (V<T>& p : out.b)
    for (int k = 0; k < 3; ++k) p[k] = p[k] * squareA;
  return out;
}

/// Width of the slab across ±n times |n|, the wider one.
template <class T>
T width(const Placed<T>& solids, const V<T>& n) {
  T lowA = dot(n, solids.a[0]), highA = lowA, lowB = dot(n, solids.b[0]), highB = lowB;
  for (const V<T>& p : solids.a) {
    const T h = dot(n, p);
    if (h < lowA) lowA = h;
    if (h > highA) highA = h;
  }
  for (const V<T>& p : solids.b) {
    const T h = dot(n, p);
    if (h < lowB) lowB = h;
    if (h > highB) highB = h;
  }
  const T up = lowA - highB, down = lowB - highA;
  return up > down ? up : down;
}

/// +1 apart, 0 touching, −1 overlapping.
class Sign {
 public:
  Sign(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB)
      : a_(exact::outlineOf(a)), b_(exact::outlineOf(b)), poseA_(poseA), poseB_(poseB) {}

  int operator()() {
    rough_ = placed<long double>(a_, poseA_, b_, poseB_);
    size_ = 0.0;
    for (const auto& p : rough_.a) size_ = std::max(size_, norm(p));
    for (const auto& p : rough_.b) size_ = std::max(size_, norm(p));
    for (const auto& f : a_.faces) tryFace(false, f);
    for (const auto& f : b_.faces) tryFace(true, f);
    for (const auto& i : a_.edges)
      for (const auto& j : b_.edges) tryEdges(i, j);
    return sign_;
  }
  int exactAxes() const { return exactAxes_; }

 private:
  static long double norm(const V<long double>& v) { return std::sqrt(dot(v, v)); }
  const Placed<Integer>& fine() {
    if (fine_.a.empty()) fine_ = placed<Integer>(a_, poseA_, b_, poseB_);
    return fine_;
  }
  template <class Axis>
  void tryAxis(const V<long double>& n, long double sine, Axis axis) {
    if (sign_ > 0) return;
    const long double length = norm(n);
    if (sine > 1e-3L && length > 0.0L) {
      const long double gap = width(rough_, n) / length;
      if (gap > 1e-16L * size_) sign_ = 1;
      if (std::abs(gap) > 1e-16L * size_) return;
    }
    ++exactAxes_;
    const V<Integer> e = axis();
    if (e[0] == 0 && e[1] == 0 && e[2] == 0) return;
    const Integer w = width(fine(), e);
    sign_ = std::max(sign_, w > 0 ? 1 : w < 0 ? -1 : 0);
  }
  void tryFace(bool ofB, const std::array<int, 3>& f) {
    const auto normal = [&](const auto& solids) {
      const auto& p = ofB ? solids.b : solids.a;
      return cross(minus(p[f[1]], p[f[0]]), minus(p[f[2]], p[f[0]]));
    };
    const auto& p = ofB ? rough_.b : rough_.a;
    const V<long double> n = normal(rough_);
    const long double sides = norm(minus(p[f[1]], p[f[0]])) * norm(minus(p[f[2]], p[f[0]]));
    tryAxis(n, norm(n) / sides, [&] { return normal(fine()); });
  }
  void tryEdges(const std::array<int, 2>& i, const std::array<int, 2>& j) {
    const auto ea = minus(rough_.a[i[1]], rough_.a[i[0]]);
    const auto eb = minus(rough_.b[j[1]], rough_.b[j[0]]);
    const V<long double> n = cross(ea, eb);
    tryAxis(n, norm(n) / (norm(ea) * norm(eb)), [&] {
      return cross(minus(fine().a[i[1]], fine().a[i[0]]), minus(fine().b[j[1]], fine().b[j[0]]));
    });
  }

  Outline a_, b_;
  Pose poseA_, poseB_;
  Placed<long double> rough_;
  Placed<Integer> fine_;
  long double size_ = 0.0;
  int sign_ = -1, exactAxes_ = 0;
};

}  // namespace tumble::exact
