// Chapter 8, joint: the one place that says how far a joint is from being met, how fast that
// changes, and by which row of the Jacobian.
#pragma once

#include "sim/joint/joint.h"
#include "sim/problem/problem.h"

namespace tumble {

/// One condition of a joint at one moment: gap = 0, or gap ≥ 0 of a limit.
///   gap˙ = J v,   gap¨ = J v̇ + J̇ v
struct JointRow {
  Row row;            ///< J; its bias is J̇ v [m/s², rad/s²]
  double gap = 0.0;   ///< [m] or [rad]
  double rate = 0.0;  ///< [m/s] or [rad/s]
  double arm = 1.0;   ///< what makes metres of it: 1, or the joint's arm [m]
  int limit = -1;     ///< 0: the lower limit; 1: the upper; −1: an equality
  int place = 0;      ///< its number among the rows of the joint
};

/// All conditions of a joint, equalities first. With pa, pb the anchors, u fixed in b, w in a:
///   point     u·(pa − pb)          J: as of a contact at pa with normal u
///                                  J̇ v = u·(ωa×(ωa×ra) − ωb×(ωb×rb) − 2 ωb×(ṗa − ṗb))
///   distance  |pa − pb| − length   along d, with |ṗa − ṗb across d|²/|pa − pb|
///   axes      w·u                  J: (ωa − ωb)·(w × u)
///   turn      atan2(v·w, u·w)      v = axis × u; measured from the middle of its limits
/// Featherstone, Rigid Body Dynamics Algorithms, §8.3. Departure: no minimal coordinates.
/// ra, rb reach from the centres of mass to pa. Bodies need current R and velocities.
void jointRows(std::span<const RigidBody> bodies, const Joint& joint, std::vector<JointRow>& rows);

/// How far the joints are from being met [m]: the largest |gap|, or −gap of a limit, turns times
/// the arm.
double largestJointGap(std::span<const RigidBody> bodies, std::span<const Joint> joints);

/// The first joint whose parts lie so far apart, by a tenth of its arm, that it holds nothing any
/// more; null without one.
const Joint* brokenJoint(std::span<const RigidBody> bodies, std::span<const Joint> joints);

}  // namespace tumble
