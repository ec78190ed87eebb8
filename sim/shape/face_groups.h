// Chapter 2, shape: which faces of a mesh lie in one plane, if their corners may be off by a
// little.
#pragma once

#include <vector>

#include "sim/shape/polyhedron.h"

namespace tumble {

/// Faces that lie in one plane n·(x − middle) = 0 nearly, the best for their corners: the sum of
/// squares of their heights over it is least.
struct FaceGroup {
  std::vector<int> corners;    ///< indices into points, in order
  Vec3 middle = Vec3::Zero();  ///< [m] of the corners
  Vec3 n = Vec3::Zero();       ///< [1] unit; on which side the solid is, is not told
  double off = 0.0;            ///< [m] the largest height of a corner
};

/// The groups of four corners or more whose corners are off their plane by no more than `open` [m]:
/// the largest face left takes what hangs together with it as long as one plane is left to all, and
/// groups apart that share a plane and a side are one, if no face is a step between them.
std::vector<FaceGroup> faceGroups(const Polyhedron& solid, double open);

}  // namespace tumble
