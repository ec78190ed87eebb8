// Surfaces of meshes and compounds as triangles to be drawn.
#pragma once

#include <memory>

#include "render/picture.h"
#include "sim/shape/shape.h"

namespace tumble {

/// The surface of a mesh or a compound about its body origin; null for any other shape. Faces that
/// meet at less than 30° are shaded as one smooth surface; steeper edges are drawn as lines. The
/// parts of a compound are drawn whole, balls and cylinders in 48 sides.
std::shared_ptr<const Facets> facetsOf(const Shape& shape);

/// The same for any solid whose points stand at stretch · p in the body frame, as those of a body
/// whose matrix is no rotation; null for a half-space and a particle.
std::shared_ptr<const Facets> facetsOf(const Shape& shape, const Mat3& stretch);

}  // namespace tumble
