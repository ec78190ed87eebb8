// The planes between bodies that pass each other, from sample to sample: remembered or sought anew.
#pragma once

#include <map>
#include <vector>

#include "app/record/recording.h"
#include "sim/collide/witness.h"

namespace tumble {

/// A convex part of a body, posed in the world.
struct PlacedPart {
  int body = 0, part = 0;
  Shape solid;
  Pose pose;
};

/// The convex parts of all bodies at a sample; half-spaces have none.
std::vector<PlacedPart> placedParts(const Scene& scene, const Sample& sample);

/// The corners [m] of a box or hull, world frame; none of round solids.
std::vector<Vec3> cornersOf(const Shape& solid, const Pose& pose);

/// A plane between two convex parts that are near each other.
struct Parting {
  PlacedPart a, b;          ///< of two bodies, b the earlier one in the scene
  Vec3 n = Vec3::UnitY();   ///< [1] out of b towards a, world frame
  double gap = 0.0;         ///< [m] between the parts along n
  bool remembered = false;  ///< the plane of the sample before parts them still
};

/// Walks through the samples of a run, in order, and keeps the planes that parted near parts.
class Coherence {
 public:
  explicit Coherence(const Scene& scene) : scene_(scene) {}

  /// Every pair of parts, not both fixed, less than the sum of its radii apart.
  std::vector<Parting> look(const Sample& sample);

  long pairs() const { return pairs_; }        ///< looked at so far
  long searches() const { return searches_; }  ///< of these, not answered by a remembered plane

 private:
  Parting part(const PlacedPart& a, const PlacedPart& b);

  const Scene& scene_;
  std::map<std::array<int, 4>, Witness> planes_;
  long pairs_ = 0, searches_ = 0;
};

}  // namespace tumble
