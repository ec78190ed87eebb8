// Chapter 5, collide: what a cylinder shows where it may touch a plane.
#pragma once

#include <cmath>

#include "sim/collide/core.h"
#include "sim/collide/facet.h"
#include "sim/collide/rim.h"

namespace tumble::convex {

/// A cap that leans by less has no outermost point that could be followed.
inline constexpr double kFlatCap = 1e-6;
/// One that leans by less than this has no outermost point at all.
inline constexpr double kLevelCap = 1e-9;
/// A cylinder shows a cap if its axis is nearer to n than 45 degrees, else its side.
inline constexpr double kShowsCap = 0.7071067811865476;
/// Points of a rim that ride on the cylinder; the outermost has the next number.
inline constexpr int kRimPoints = 8;
constexpr int rimNumber(int cap) {
  return 2 * kRimPoints + cap;
}

/// A point of a rim.
struct RimSpot {
  Vec3 p;              ///< [m]
  std::uint32_t code;  ///< see features.h
  bool follows;        ///< it is the outermost, and wanders along the rim
};

/// Where the axis of a cylinder is this far from n [1], its cap leans.
inline double leanOf(const Core& core, const Vec3& n) {
  return core.axis().cross(n).norm();
}

/// Calls visit(RimSpot) for the points of the rim of cap 0 or 1 that may touch a plane square to
/// the unit vector n, outermost along n: the outermost, if the cap leans, and of a cap that faces
/// the plane eight that ride on it, less those near the outermost.
template <class Visit>
void visitRim(const Core& core, int cap, const Vec3& n, Visit visit) {
  constexpr double d = 0.7071067811865476, kNear = 0.7, kSame = 1e-6;
  constexpr double cosines[kRimPoints] = {1, d, 0, -d, -1, -d, 0, d};
  const Vec3 u = core.axis(), e2 = u.cross(core.side);
  const double lean = leanOf(core, n);
  const bool follows = lean >= kFlatCap;
  const Vec3 out = lean > kLevelCap ? outermostOnRim(u, core.disc, n).out : Vec3(Vec3::Zero());
  bool known = lean <= kLevelCap;
  const double way = u.dot(n) * (cap == 1 ? 1.0 : -1.0);
  for (int k = 0; k < kRimPoints && way > kShowsCap; ++k) {
    const Vec3 rides = cosines[k] * core.side + cosines[(k + 6) % kRimPoints] * e2;
    if (follows && rides.dot(out) > kNear) continue;
    known = known || (rides - out).norm() < kSame;
    visit(RimSpot{core.points[cap] + core.disc * rides, vertexCode(2 * k + cap), false});
  }
  if (!known)
    visit(RimSpot{core.points[cap] + core.disc * out, vertexCode(rimNumber(cap)), follows});
}

}  // namespace tumble::convex
