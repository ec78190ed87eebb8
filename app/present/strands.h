// Strands of fur, as thin tubes.
#pragma once

#include <vector>

#include "app/record/recording.h"
#include "app/scene/scene.h"
#include "render/picture.h"

namespace tumble {

/// The strands of a fur at a sample: tubes along smooth curves through their points, from the root
/// to a thin tip, in three shades of the colour.
std::vector<Instance> strandTubes(const BentDef& fur, const Sample& sample, const Colour& colour);

}  // namespace tumble
