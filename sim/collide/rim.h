// Chapter 5, collide: the circle in which the side of a cylinder meets a cap.
#pragma once

#include "sim/math/vec.h"

namespace tumble {

/// The point of a circle that is outermost along a direction, and how it wanders as that turns.
struct RimPoint {
  Vec3 out;           ///< [1] unit, from the centre of the circle to the point
  Vec3 along;         ///< [1] unit tangent of the circle there
  double bend = 0.0;  ///< [m] radius of curvature of the solid along the tangent
  double lean = 1.0;  ///< [1] sine of the angle between the direction and the axis
};

/// The point of a circle of radius r [m] about the unit vector `axis` that is outermost along m:
///   out = (m − (m·u) u)/s,   s = |m − (m·u) u|,   bend = r/s,   lean = s
/// @param m  [1] unit, not along the axis
inline RimPoint outermostOnRim(const Vec3& axis, double r, const Vec3& m) {
  Vec3 lean = m - m.dot(axis) * axis;
  lean -= lean.dot(axis) * axis;  // what is left along the axis may be all rounding
  const double s = lean.norm();
  const Vec3 out = lean / s;
  return {out, axis.cross(out), r / s, s};
}

}  // namespace tumble
