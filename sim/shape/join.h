// Chapter 2, shape: solids measured, and convex ones joined where their union is convex.
#pragma once

#include <optional>
#include <vector>

#include "sim/shape/polyhedron.h"
#include "sim/shape/shape.h"

namespace tumble {

/// How far [m] the farthest point is from the first.
double sizeOf(const Polyhedron& solid);

/// Volume [m³] and surface [m²].
double volumeOf(const Polyhedron& solid);
double areaOf(const Polyhedron& solid);

/// The half-spaces of a convex solid's faces.
std::vector<HalfSpace> facesOf(const Polyhedron& convex);

/// How far [m] points of a convex solid are from the solid K below these planes and its own faces,
/// at most. K is convex, so that a corner is farthest. Infinite if the middle of the corners is not
/// in K.
/// @param looks  grows by the planes looked at, if given
double reachOver(const Polyhedron& convex, std::vector<HalfSpace> planes, long* looks = nullptr);

/// How far [m] the highest of some points is over the planes; 0 if all are below.
double heightOver(const std::vector<HalfSpace>& planes, const std::vector<Vec3>& points);

/// What of a convex solid is below the planes; corners within `on` [m] of one are on it. Nothing if
/// that is flatter than numbers can tell.
std::optional<Polyhedron> below(const Polyhedron& convex, const std::vector<HalfSpace>& planes,
                                double on);

/// How two solids may be joined.
struct Joining {
  double thin = 0.0;   ///< [m] all over the surface of the hull of both: what volume may differ by
  double slack = 0.0;  ///< [m] solids whose boxes are no further apart may touch
  double reach = 0.0;  ///< [m] that what is joined may reach out of all that it is made of
};

/// Joins convex solids that share no volume wherever two of them make a convex one: the hull of
/// both has no more volume than they have together, and reaches out of them no further than is
/// allowed. Solids without corners are left out.
/// @return [m] how far any of them reaches out of what it is made of, at most
double joinConvex(std::vector<Polyhedron>& solids, const Joining& joint);

}  // namespace tumble
