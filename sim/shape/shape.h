// Chapter 2, shape: what bodies are made of.
#pragma once

#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/math/vec.h"
#include "sim/shape/polyhedron.h"

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

/// Cylinder with half-balls for caps: all points within r [m] of the segment of length h [m] along
/// body Y, which is centred at the body origin.
struct Capsule {
  double r = 0.5, h = 1.0;  ///< h without the caps
};

/// Convex hull of points, shared by all bodies that are made of it.
struct Hull {
  std::shared_ptr<const Polyhedron> solid;  ///< made by `convexHull`
  Vec3 origin = Vec3::Zero();               ///< [m] the body origin, in the polyhedron's frame
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

/// Ellipsoid of semi-axes [m] along the body axes, centred at the body origin:
///   |diag(half)⁻¹ p| ≤ 1
struct Ellipsoid {
  Vec3 half = Vec3::Constant(0.5);
};

struct Pieces;

/// A polyhedron, shared by all bodies that are made of it.
struct Mesh {
  std::shared_ptr<const Polyhedron> solid;    ///< checked by `makePolyhedron`
  Vec3 origin = Vec3::Zero();                 ///< [m] the body origin, in the polyhedron's frame
  std::shared_ptr<const Pieces> pieces = {};  ///< that others meet, see pieces.h; none: nothing can
};

/// A convex piece of a compound, in the compound's frame.
struct Part {
  std::variant<Sphere, Box, Cylinder, Capsule, Hull> solid;
  Pose pose;
};

struct Parts;

/// The union of convex parts that touch at most.
struct Compound {
  std::vector<Part> parts;
  Vec3 origin = Vec3::Zero();  ///< [m] the body origin, in the parts' frame
  double slack = 0.0;          ///< [m] parts that touch may overlap, or gape, by as much
  std::shared_ptr<const Parts> ready = {};  ///< for contact, as `readyShape` leaves them
};

using Shape = std::variant<Sphere, Box, Cylinder, Capsule, Hull, HalfSpace, Particle, Mesh,
                           Compound, Ellipsoid>;

/// Axis-aligned box in the world frame [m].
struct Aabb {
  Vec3 lo = Vec3::Zero(), hi = Vec3::Zero();
  bool overlaps(const Aabb& o) const {
    return lo.x() <= o.hi.x() && lo.y() <= o.hi.y() && lo.z() <= o.hi.z() && o.lo.x() <= hi.x() &&
           o.lo.y() <= hi.y() && o.lo.z() <= hi.z();
  }
};

/// "sphere", "box", "cylinder", "capsule", "hull", "half-space", "particle", "mesh", "compound" or
/// "ellipsoid".
std::string_view shapeName(const Shape& shape);

/// Whether it is a hull, a mesh or a compound, which are given in a frame that may begin anywhere;
/// others are symmetric about the body origin.
bool hasOwnFrame(const Shape& shape);

/// The shape with its body origin at a point [m] of the frame in which it was given; one without
/// such a frame stays as it is.
Shape withOrigin(Shape shape, const Vec3& origin);

/// The body origin [m] in the frame in which the shape was given.
Vec3 originOf(const Shape& shape);

/// A part as a shape of its own, and where it stands in the body frame.
Shape shapeOf(const Part& part);
Pose poseInBody(const Compound& compound, const Part& part);

/// A convex solid and where it stands in the body frame.
struct PosedPart {
  Shape solid;
  Pose pose;
};

/// The convex parts that a shape is the union of: those of a compound; of any other the shape
/// itself at the body origin, a particle with a radius as its ball. A mesh without pieces has none,
/// nor has a particle without a radius.
std::vector<PosedPart> convexParts(const Shape& shape);

/// Smallest axis-aligned box around a posed shape, grown by `margin` [m] on every side.
/// A half-space has none: ±infinity.
Aabb boundingBox(const Shape& shape, const Pose& pose, double margin = 0.0);

/// What others meet when they touch the shape: the ball of a particle that has a radius; the
/// compound of a mesh's pieces; every other shape as it is.
Shape contactShape(const Shape& shape);

/// False for what meets nothing: a particle without a radius.
bool touchesAnything(const Shape& shape);

/// Radius [m] of the ball about the body origin that holds the shape; infinity for a half-space.
double boundingRadius(const Shape& shape);

}  // namespace tumble
