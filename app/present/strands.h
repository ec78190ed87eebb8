// Strands of fur, as thin tubes.
#pragma once

#include <array>
#include <vector>

#include "app/record/recording.h"
#include "app/scene/scene.h"
#include "render/picture.h"

namespace tumble {

/// The strands of a fur at a sample: tubes along smooth curves through their points, from the root
/// to a thin tip, in three shades of the colour.
std::vector<Instance> strandTubes(const BentDef& fur, const Sample& sample, const Colour& colour);

/// In how many parts each piece of a strand is drawn; those three shades, strand by strand in turn.
inline constexpr int kPartsOfStrands = 2;
std::array<Colour, 3> shadesOfStrands(const Colour& colour);

}  // namespace tumble
