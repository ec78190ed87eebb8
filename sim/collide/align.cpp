#include "sim/collide/align.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tumble {
namespace {

// [1] Turns below this are rounding.
constexpr double kStill = 1e-16;
// [1] Only rounding keeps turns below this from getting smaller.
constexpr double kNearlyStill = 1e-10;
// [1] The largest turn of n at once, in units of its lean against the axis of a rim, beyond which
// it would go round to the other side.
constexpr double kStride = 0.5;
constexpr int kMostTurns = 32;

Vec3 across(const Vec3& v, const Vec3& e) {
  return v - v.dot(e) * e;
}

// The turn of n that Newton's method asks for; NaN where n is not the widest near it.
Vec3 turnOf(const ContactPoint& c, const RimPoint& a, const RimPoint& b, const Vec3* edge) {
  const Vec3 way = c.pa - c.pb;
  const double reach = c.n.dot(way);
  const auto bent = [&](const Vec3& t, const Vec3& u) {
    return a.bend * a.along.dot(t) * a.along.dot(u) + b.bend * b.along.dot(t) * b.along.dot(u);
  };
  const Vec3 none = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  if (edge) {
    const Vec3 t = edge->cross(c.n);
    const double slope = reach + bent(t, t);
    return slope > 0.0 ? Vec3((t.dot(way) / slope) * t) : none;
  }
  const Vec3 t = c.n.unitOrthogonal(), u = c.n.cross(t);
  const double tt = reach + bent(t, t), uu = reach + bent(u, u), tu = bent(t, u);
  const double det = tt * uu - tu * tu, wt = t.dot(way), wu = u.dot(way);
  if (!(det > 0.0 && tt > 0.0)) return none;
  return ((uu * wt - tu * wu) / det) * t + ((tt * wu - tu * wt) / det) * u;
}

}  // namespace

RimPoint rimOfA(const ContactPoint& c) {
  if (c.rimA == 0.0) return {Vec3::Zero(), Vec3::Zero()};
  return outermostOnRim(c.ea, c.rimA, -c.n);
}

RimPoint rimOfB(const ContactPoint& c) {
  if (c.rimB == 0.0) return {Vec3::Zero(), Vec3::Zero()};
  return outermostOnRim(c.eb, c.rimB, c.n);
}

bool alignNormal(ContactPoint& c, const Vec3& fromA, const Vec3& fromB) {
  const Vec3* edge = c.tie == NormalTie::EdgeOfB   ? &c.eb
                     : c.tie == NormalTie::EdgeOfA ? &c.ea
                                                   : nullptr;
  double size = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostTurns; ++k) {
    if (edge) c.n = across(c.n, *edge).normalized();
    const RimPoint a = rimOfA(c), b = rimOfB(c);
    c.pa = fromA + c.rimA * a.out;
    c.pb = fromB + c.rimB * b.out;
    const Vec3 turn = turnOf(c, a, b, edge);
    const double last = std::exchange(size, turn.norm());
    if (!std::isfinite(size) || size <= kStill || (size >= last && size < kNearlyStill)) break;
    const double stride = kStride * std::min(a.lean, b.lean);
    c.n = (c.n + std::min(1.0, stride / size) * turn).normalized();
  }
  const double reach = c.n.dot(c.pa - c.pb);
  c.separation = reach - c.ra - c.rb;
  if (c.tie == NormalTie::EdgeOfB) c.pb = c.pa - reach * c.n;
  if (c.tie == NormalTie::EdgeOfA) c.pa = c.pb + reach * c.n;
  return size < kNearlyStill;
}

}  // namespace tumble
