// Chapter 5, collide: the table of shape pairs.
#pragma once

#include "sim/collide/contact_point.h"
#include "sim/collide/witness.h"
#include "sim/shape/shape.h"

namespace tumble {

/// True if the table has a row for these two kinds of shape, in either order.
bool canCollide(const Shape& a, const Shape& b);

/// Signed gap [m] between two posed shapes: > 0 apart (then a lower bound of the distance, and no
/// shorter than the widest separating plane found), 0 touching, < 0 overlapping (then the least
/// depth over the candidate planes). Continuous in the poses; its sign is exact up to rounding.
double separation(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB);

/// The widest plane found between two posed shapes, as a contact point of which n, separation, tie
/// and the edges that the tie names are set; of a ball, the material points and radii too. The gap
/// of the shapes along n is at least `separation` (then > 0), and no wider plane was found.
/// Lecture on collision: separating planes (slides SH24–SH26).
ContactPoint separatingPlane(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB);

/// Writes all contact points of a pair whose separation is at most `margin` [m] into `out`
/// (cleared first): the full manifold, clipped, with one normal. Order and features depend on the
/// poses alone. Of compounds it is the union of the manifolds of their parts, each with its own
/// normal, less what other parts of the same body cover (seam.h); `separation` is then the least
/// over pairs of parts, and `separatingPlane` that of the nearest pair.
void collide(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB, double margin,
             Manifold& out);

/// Near pairs of parts, or of boxes of them, that were asked for a plane, and those of them that a
/// remembered plane answered.
struct PartLooks {
  long tests = 0, hits = 0;
};

/// The same with a memory of the planes that parted the near parts of two compounds a moment ago,
/// which is renewed; it stays empty where neither is a compound.
void collide(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB, double margin,
             Manifold& out, std::vector<PartWitness>& known, PartLooks& looks);

}  // namespace tumble
