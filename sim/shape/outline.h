// Chapter 2, shape: the outermost points of a convex solid.
#pragma once

#include <vector>

#include "sim/shape/shape.h"

namespace tumble {

/// A convex solid as what it is the hull of: points, circles and ellipsoids, all thickened to a
/// radius. How far it reaches along a direction m is  max(max_k m·p_k, max_i (m·c_i + r_i |m across
/// the axis|), max_i (m·c_i + |E_iᵀ m|)) + round |m|. Body frame, SI.
struct Outline {
  /// A circle of radius r [m] about `centre`, in the plane of the unit vectors u and v.
  struct Rim {
    Vec3 centre = Vec3::Zero(), u = Vec3::UnitX(), v = Vec3::UnitZ();
    double r = 0.0;
  };
  /// The image of the unit ball under E, about `centre`.
  struct Oval {
    Vec3 centre = Vec3::Zero();
    Mat3 E = Mat3::Identity();  ///< [m]
  };
  std::vector<Vec3> points;  ///< [m]
  std::vector<Rim> rims;
  std::vector<Oval> ovals;
  double round = 0.0;   ///< [m]
  double corner = 0.0;  ///< [m] greatest distance of all these from the body origin
  double radius() const { return corner + round; }
};

/// The outline of a convex shape whose own frame stands at `pose` in the body frame. A half-space
/// has none: empty.
Outline outlineOf(const Shape& shape, const Pose& pose = {});

/// The point of an outline that is outermost along m, its round part included. Body frame.
Vec3 outermost(const Outline& outline, const Vec3& m);

/// A convex part of a body: its shape, where that stands in the body frame, and its outline there.
struct Convex {
  Shape shape;
  Pose pose = {};
  Outline outline = {};
};

/// The convex parts of a shape that can touch others.
std::vector<Convex> outlinedParts(const Shape& shape);

}  // namespace tumble
