// Chapter 2, shape: what bodies are made of.
#pragma once

#include <string_view>
#include <variant>

#include "sim/math/vec.h"

namespace tumble {

/// Ball of radius r [m] about the body origin.
struct Sphere {
  double r = 0.5;
};

/// Box of half edges [m] along the body axes, centred at the body origin.
struct Box {
  Vec3 half = Vec3::Constant(0.5);
};

/// Cylinder of radius r [m] and full height h [m] along body Y, centred at the body origin.
struct Cylinder {
  double r = 0.5, h = 1.0;
};

/// Solid half-space n·p < d. World frame, n unit; always fixed.
struct HalfSpace {
  Vec3 n = Vec3::UnitY();
  double d = 0.0;  ///< [m]
};

/// Point of mass that does not turn. It meets nothing, unless it has a radius [m]: then it is a
/// ball to all others.
struct Particle {
  double radius = 0.0;
};

using Shape = std::variant<Sphere, Box, Cylinder, HalfSpace, Particle>;

/// Axis-aligned box in the world frame [m].
struct Aabb {
  Vec3 lo = Vec3::Zero(), hi = Vec3::Zero();
  bool overlaps(const Aabb& o) const {
    return (lo.array() <= o.hi.array()).all() && (o.lo.array() <= hi.array()).all();
  }
};

/// "sphere", "box", "cylinder", "half-space" or "particle".
std::string_view shapeName(const Shape& shape);

/// Smallest axis-aligned box around a posed shape, grown by `margin` [m] on every side.
/// A half-space has none: ±infinity.
Aabb boundingBox(const Shape& shape, const Pose& pose, double margin = 0.0);

/// What others meet when they touch the shape: the ball of a particle that has a radius; every
/// other shape as it is.
Shape contactShape(const Shape& shape);

/// False for what meets nothing: a particle without a radius.
bool touchesAnything(const Shape& shape);

/// Radius [m] of the ball about the body origin that holds the shape; infinity for a half-space.
double boundingRadius(const Shape& shape);

}  // namespace tumble
