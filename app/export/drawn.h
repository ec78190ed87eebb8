// What a run looks like, as other programs are told: bodies of a few shared forms, and their poses.
#pragma once

#include <vector>

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// A body as it is drawn at the start of the run; a floor is left out, another half-space is a
/// slab.
struct DrawnBody {
  int body = 0;        ///< its number in the scene
  Instance instance;   ///< form, size, colour, and the pose at the start
  bool moves = false;  ///< whether any sample has it at another pose
};

/// @param recording with at least one sample
std::vector<DrawnBody> drawnBodies(const Scene& scene, const Recording& recording);

/// Triangles with one normal a corner, each corner once.
struct IndexedMesh {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<std::uint32_t> indices;  ///< three a triangle, counter-clockwise from outside
};

/// The surface that an instance scales: corners at ±1 for a box, radius 1 for what is round (a
/// cylinder along Y from −1 to 1), the facets themselves [m].
IndexedMesh meshOf(const Instance& instance);

}  // namespace tumble
