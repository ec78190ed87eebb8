// Chapter 5, collide: which features of two bodies touch.
#pragma once

#include <span>
#include <string_view>

#include "sim/collide/contact_point.h"
#include "sim/shape/shape.h"

namespace tumble {

/// The ways in which polyhedra touch: what the contact is part of on one body and on the other.
enum class ContactKind { VertexVertex, VertexEdge, VertexFace, EdgeEdge, EdgeFace, FaceFace };

/// "vertex-vertex", "vertex-edge", "vertex-face", "edge-edge", "edge-face" or "face-face".
std::string_view contactKindName(ContactKind kind);

/// The kind of a manifold: on each body the least feature – vertex, edge or face – that holds all
/// its points to `tolerance` [m]. Of a ball the centre counts as a vertex, of a capsule the segment
/// as an edge, of a cylinder the rims and the lines of its side as edges; a half-space is a face.
/// @param manifold  one point or more, of one pair of convex bodies with one normal
ContactKind contactKind(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB,
                        std::span<const ContactPoint> manifold, double tolerance);

}  // namespace tumble
