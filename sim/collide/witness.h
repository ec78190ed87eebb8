// Chapter 5, collide: coherence (slide SD40). A plane that parted two bodies a moment ago parts
// them still, as a rule; to see that it does costs less than to find it.
#pragma once

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

/// The witness of a plane found at these poses, as by `separatingPlane`.
Witness witnessOf(const ContactPoint& plane, const Pose& poseA, const Pose& poseB);

/// The witness's normal where its features are now: [1] unit, world frame, out of b towards a.
Vec3 normalOf(const Witness& witness, const Quat& qa, const Quat& qb);

/// Width [m] of the slab between two shapes along the witness, where its features are now: at most
/// the distance of the shapes. O(corners); −∞ of meshes.
///   gap(n) = n·(xa − xb) − max over a of −n·R p_B − max over b of n·R p_B
double gapAlong(const Witness& witness, const Shape& a, const Pose& poseA, const Shape& b,
                const Pose& poseB);

/// Whether the witness shows that `collide` would find no point within `margin` [m]. Never wrong
/// when it says so; a plane that is known no more, or too near, shows nothing.
bool showsApart(const Witness& witness, const Shape& a, const Pose& poseA, const Shape& b,
                const Pose& poseB, double margin);

}  // namespace tumble
