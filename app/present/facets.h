// Surfaces of capsules, hulls, meshes and compounds as triangles to be drawn.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "render/picture.h"
#include "sim/method/model.h"

namespace tumble {

/// The surface of a capsule, hull, mesh or compound about its body origin; null for any other
/// shape. Faces that meet at less than 30° are shaded as one smooth surface; steeper edges are
/// drawn as lines. The parts of a compound are drawn whole, round ones in 48 sides.
std::shared_ptr<const Facets> facetsOf(const Shape& shape);

/// The same for each body; those of one capsule, hull or mesh share a surface.
std::vector<std::shared_ptr<const Facets>> facetsOfBodies(std::span<const BodyDef> bodies);

/// The same for any solid whose points stand at stretch · p in the body frame, as those of a body
/// whose matrix is no rotation; null for a half-space and a particle.
std::shared_ptr<const Facets> facetsOf(const Shape& shape, const Mat3& stretch);

}  // namespace tumble
