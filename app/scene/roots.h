// Places on the surface of a shape where strands grow, spread evenly.
#pragma once

#include <string>
#include <vector>

#include "app/scene/random.h"
#include "sim/shape/shape.h"

namespace tumble {

/// A place of a surface, in the body frame.
struct Root {
  Vec3 place = Vec3::Zero();    ///< [m]
  Vec3 normal = Vec3::UnitY();  ///< [1] outward
};

/// Where roots may be: where the normal is at most so far from a direction of the body frame.
struct RootArea {
  Vec3 towards = Vec3::UnitY();  ///< [1] unit
  double least = -1.0;           ///< of towards·normal
};

/// Why nothing grows on a shape: "a half-space has no end"; "" if something does.
std::string barrenness(const Shape& shape);

/// Roots spread evenly over a surface: each is the one of eight random places that is farthest
/// from all before it (Mitchell, Spectrally Optimal Sampling for Distribution Ray Tracing, 1991).
/// The same seed gives the same roots.
/// @param shape  of the body, with its origin where the body's is
/// @return fewer than `count` if the area is too small a part of the surface to be met
std::vector<Root> rootsOn(const Shape& shape, const RootArea& area, int count, Random random);

}  // namespace tumble
