// Paths of centres of mass.
#pragma once

#include <span>

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// A line for each moving body, through its samples 0 … last and its places at the hits between
/// them: in ink for a single body, else in a darker shade of the body's colour.
void addPaths(const Scene& scene, const Recording& recording, std::span<const Colour> colours,
              int last, Picture& picture);

}  // namespace tumble
