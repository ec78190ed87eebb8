// Chapter 5, collide: coherence (slide SD40). A plane that parted two bodies a moment ago parts
// them still, as a rule; to see that it does costs less than to find it.
#pragma once

#include <vector>

#include "sim/collide/contact_point.h"
#include "sim/shape/shape.h"

namespace tumble {

/// A plane that rides on the features it was found on.
struct Witness {
  bool known = false;
  NormalTie tie = NormalTie::FaceOfB;
  Vec3 n_B = Vec3::Zero();                        ///< [1] in the frame of the body it is tied to
  Vec3 ea_B = Vec3::Zero(), eb_B = Vec3::Zero();  ///< [1] edges, if it is tied to two
};

/// A plane that parts all parts below one box of a compound's tree from all below one of another's.
struct PartWitness {
  int i = 0, j = 0;  ///< boxes of the trees of a and of b; 0 of a shape that is no compound
  Witness plane;     ///< in the frames of the bodies
};

/// What is remembered of two bodies: a plane that parts all of both, or, where there is none
/// because one reaches around the other, the planes between their near parts.
struct PairWitness {
  Witness whole;
  std::vector<PartWitness> parts;
};

/// The witness of a plane found at these poses, as by `separatingPlane`.
Witness witnessOf(const ContactPoint& plane, const Pose& poseA, const Pose& poseB);

/// The witness's normal where its features are now: [1] unit, world frame, out of b towards a.
Vec3 normalOf(const Witness& witness, const Quat& qa, const Quat& qb);

/// How far [m] a shape reaches above its origin along n, both in its body frame; infinity for
/// half-spaces and meshes.
double reachAlong(const Shape& shape, const Vec3& n);

/// Width [m] of the slab between two shapes along the witness, where its features are now: at most
/// the distance of the shapes. O(corners); −∞ of meshes.
///   gap(n) = n·(xa − xb) − max over a of −n·R p_B − max over b of n·R p_B
double gapAlong(const Witness& witness, const Shape& a, const Pose& poseA, const Shape& b,
                const Pose& poseB);

/// Whether the witness shows that `collide` would find no point within `margin` [m]. Never wrong
/// when it says so; a plane that is known no more, or too near, shows nothing.
bool showsApart(const Witness& witness, const Shape& a, const Pose& poseA, const Shape& b,
                const Pose& poseB, double margin);

/// The same where their bounding radii [m] are known, which takes all corners to find.
bool showsApart(const Witness& witness, const Shape& a, const Pose& poseA, double radiusA,
                const Shape& b, const Pose& poseB, double radiusB, double margin);

}  // namespace tumble
