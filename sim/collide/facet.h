// Chapter 5, collide: the part of a solid's surface that lies outermost along a direction.
#pragma once

#include "sim/collide/core.h"

namespace tumble::convex {

/// A polygon, a segment or a point. Frame of b.
struct Facet {
  Few<Vec3> corners;               ///< [m] counter-clockwise seen from outside
  Few<std::uint32_t> cornerCodes;  ///< see features.h
  Few<std::uint32_t> sideCodes;    ///< of the side that leaves each corner
  std::uint32_t code = 0;          ///< of the whole
  Vec3 normal = Vec3::Zero();      ///< [1] of a polygon, outward unit

  bool isPolygon() const { return corners.size() > 2; }
};

/// The facet of a core, not of a cylinder, whose normal is nearest to the unit vector n, among
/// those with most of its outermost corners along n.
Facet outermostFacet(const Core& core, const Vec3& n);

/// Codes of features of a core.
constexpr std::uint32_t vertexCode(int k) {
  return static_cast<std::uint32_t>(k);
}
constexpr std::uint32_t edgeCode(int k) {
  return kEdgeCode | static_cast<std::uint32_t>(k);
}
constexpr std::uint32_t faceCode(int k) {
  return kFaceCode | static_cast<std::uint32_t>(k);
}

}  // namespace tumble::convex
