// What bends, as surfaces that go with its points.
#pragma once

#include <vector>

#include "app/record/recording.h"
#include "app/scene/scene.h"
#include "render/picture.h"

namespace tumble {

/// Per body whether it is drawn as part of such a surface, not as a ball.
std::vector<bool> partsOfSurfaces(const Scene& scene);

/// The surfaces of all that bends at a sample, smoothly shaded; a cloth has two sides half its
/// thickness from its points, each with its colour, and a rim.
/// @param colours  per body
std::vector<Instance> bentSurfaces(const Scene& scene, const Sample& sample,
                                   const std::vector<Colour>& colours);

}  // namespace tumble
