// Random contact problems that look like mechanics: boxes, faces, joints, all at velocity level.
#pragma once

#include <cstdint>

#include "sim/problem/problem.h"

namespace tumble::test {

/// Which cones a random problem may hold.
enum class Rubbing {
  None,     ///< pushing and equality rows: v is unique
  Coulomb,  ///< friction too, mu from 0 to 2
};

/// Problem number `seed` of the set: two to eight boxes, some immovable, that touch one another in
/// one to 24 points.
///   Faces of one to eight points that share a plane, so that J is of deficient rank; some points
///   twice over; mu 0, between, or 2; in a third of the problems masses from 1e-4.5 to 1e4.5 kg
///   and edges from 1 mm to 1 m, so that moments of inertia differ by 1e6 in one body.
/// An answer exists: either v = 0 obeys every row (bias 0 or a gap over the step), with ball joints
/// and welds between some bodies; or all normals point up to within 0.4 rad, the bias is Newton's
/// restitution, and everything may move up, the higher the faster.
Problem randomContacts(std::uint64_t seed, Rubbing rubbing);

}  // namespace tumble::test
