// Chapter 10, audit: how deep two bodies overlap at most, proved by a plane.
#pragma once

#include <span>
#include <vector>

#include "sim/shape/shape.h"

namespace tumble {

/// How far [m] a convex solid reaches along the world direction d, from the point `from`:
///   max over its points p of d·(p − from)
double reachOf(const Shape& solid, const Pose& pose, const Vec3& d, const Vec3& from);

/// Gap [m] of two posed convex solids along the unit vector n, out of b towards a; < 0: at most as
/// deep as that do they overlap, whoever found n.
///   min over a of n·p − max over b of n·p
double gapAlong(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB,
                const Vec3& n);

/// A gap [m] that two bodies, given by their convex parts, have at least: that along planes which
/// `collide` proposes, measured anew, and turned to where they are widest if it says more than they
/// show. The least over all pairs of parts.
double provenGap(std::span<const PosedPart> a, const Pose& poseA, std::span<const PosedPart> b,
                 const Pose& poseB);

}  // namespace tumble
