// Chapter 5, collide: how the vertices, edges and faces of a box are numbered, and which is
// nearest.
#pragma once

#include <cstdint>

#include "sim/collide/contact_point.h"
#include "sim/math/vec.h"

namespace tumble {

/// The two body axes that follow axis k in cyclic order.
constexpr int nextAxis(int k) {
  return k == 2 ? 0 : k + 1;
}
constexpr int lastAxis(int k) {
  return k == 0 ? 2 : k - 1;
}

/// Codes of the features of one body: what kind of feature, and its number among those of the kind.
/// A box has 8 vertices, 12 edges and 6 faces. A ball is a vertex, a half-space a face. Above them
/// stands the number of the part, if the body is a compound.
inline constexpr std::uint32_t kEdgeCode = 1u << 18, kFaceCode = 2u << 18, kKindCode = 3u << 18;
constexpr std::uint32_t inPart(std::uint32_t part, std::uint32_t code) {
  return part << 20 | code;
}
constexpr std::uint32_t vertexCode(bool x, bool y, bool z) {
  return (x ? 1u : 0u) | (y ? 2u : 0u) | (z ? 4u : 0u);
}
/// The edge along `axis` on the sides that the flags tell of the next and the last axis.
constexpr std::uint32_t edgeCode(int axis, bool next, bool last) {
  return kEdgeCode | (4u * static_cast<std::uint32_t>(axis) + (next ? 1u : 0u) + (last ? 2u : 0u));
}
constexpr std::uint32_t faceCode(int axis, bool positive) {
  return kFaceCode | (2u * static_cast<std::uint32_t>(axis) + (positive ? 1u : 0u));
}

/// What a contact point is called: the touching feature of a and that of b.
constexpr std::uint64_t featurePair(std::uint32_t ofA, std::uint32_t ofB) {
  return static_cast<std::uint64_t>(ofA) << 32 | ofB;
}
constexpr std::uint32_t featureOfA(std::uint64_t pair) {
  return static_cast<std::uint32_t>(pair >> 32);
}
constexpr std::uint32_t featureOfB(std::uint64_t pair) {
  return static_cast<std::uint32_t>(pair);
}
constexpr std::uint64_t swappedFeature(std::uint64_t pair) {
  return featurePair(featureOfB(pair), featureOfA(pair));
}

/// The part of a box's surface nearest to a point, body frame of the box.
struct NearestOnBox {
  Vec3 foot;              ///< [m] nearest surface point
  Vec3 normal;            ///< [1] unit, from the foot towards a point outside
  double gap;             ///< [m] distance from the surface; < 0 inside
  std::uint32_t feature;  ///< code of the vertex, edge or face that the foot is on
  NormalTie tie;          ///< FaceOfB, EdgeOfB or Points: the box as body b
  int edgeAxis;           ///< direction of the edge if the tie is EdgeOfB
};

/// Outside: the point of the box [m half edges] nearest to p [m]. Inside: the foot on the face that
/// is least deep, the lowest axis first where several are.
NearestOnBox nearestOnBox(const Vec3& p, const Vec3& half);

}  // namespace tumble
