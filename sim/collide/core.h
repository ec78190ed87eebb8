// Chapter 5, collide: what the general path sees of a convex solid: a core with a radius around it.
#pragma once

#include <boost/container/small_vector.hpp>
#include <span>

#include "sim/collide/features.h"
#include "sim/collide/gjk.h"
#include "sim/shape/shape.h"

namespace tumble::convex {

/// A list that allocates only when it grows long.
template <class T>
using Few = boost::container::small_vector<T, 32>;

/// The points nearer than `radius` to a core, and the core: a polyhedron, the segment of a capsule,
/// the centre of a ball, a cylinder or an ellipsoid. Frame of b.
struct Core {
  Few<Vec3> points;   ///< [m] vertices; of a cylinder the centres of its caps, −Y first
  Few<Vec3> normals;  ///< [1] of the faces, outward unit
  std::span<const Polyhedron::Edge> edges;
  std::span<const std::vector<int>> faces, sides;
  double radius = 0.0;                          ///< [m] about the core
  Vec3 up = Vec3::Zero(), side = Vec3::Zero();  ///< [1] unit, along and across a cylinder's axis
  double disc = 0.0;         ///< [m] radius of a cylinder's caps, 0 for other solids
  Vec3 half = Vec3::Zero();  ///< [m] semi-axes of an ellipsoid, 0 of other solids,
  Mat3 axes = Mat3::Zero();  ///< [1] and their directions; `points` has its centre
  double size = 0.0;         ///< [m] of the core, from its middle
  Vec3 middle = Vec3::Zero();

  bool isCylinder() const { return disc > 0.0; }
  bool isEllipsoid() const { return half.x() > 0.0; }
  /// Unit axis of a cylinder.
  const Vec3& axis() const { return up; }
  Vec3 along(const Polyhedron::Edge& e) const { return points[e.to] - points[e.from]; }
};

/// The cube with corners ±1, its features numbered as in features.h.
const Polyhedron& unitCube();

/// Whether the general path knows a shape; half-spaces, compounds and others it does not.
bool hasCore(const Shape& shape);

/// The core of a shape that has one, turned by R and shifted by x.
Core coreOf(const Shape& shape, const Mat3& R, const Vec3& x);

/// Number of the outermost vertex along n, the lowest where several are.
int outermostVertex(const Core& core, const Vec3& n);

/// Outermost point of a core along n, and its number if it is a vertex, else −1.
Vec3 outermost(const Core& core, const Vec3& n, int& vertex);

/// Whether a point is in a core, or outside it by no more than `off` [m], about.
bool holds(const Core& core, const Vec3& p, double off);

/// Width [m] of the slab across the unit vector n between two cores, n out of b towards a:
///   gap(n) = min over a of n·p − max over b of n·p
double coreGap(const Core& a, const Core& b, const Vec3& n);

}  // namespace tumble::convex
