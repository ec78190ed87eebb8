// Overlap of balls, boxes and planes, by separating axes: written anew, so that no engine is held
// to its own idea of it.
#pragma once

#include <span>

#include "sim/method/model.h"
#include "sim/world.h"

namespace tumble::peers {

/// How far two solids are into each other.
///   depth = min over axes of (what both reach along it − the distance of their centres along it)
/// Axes: of two boxes the normals of their faces and the products of their edges (Gottschalk, Lin,
/// Manocha, OBBTree, 1996); of a ball and a box the way to the nearest point. Balls, boxes and
/// half-spaces, of which at most one is a half-space.
/// @return [m] > 0 for an overlap; else ≤ 0, and no further apart than that
double overlap(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB);

/// The deepest overlap [m] of any two bodies of which one moves; 0 if none overlap.
double deepestOverlap(const WorldDef& world, std::span<const BodySample> bodies);

}  // namespace tumble::peers
