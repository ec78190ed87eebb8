// Starts that differ in the last place: what no method can tell apart.
#pragma once

#include "app/scene/random.h"
#include "sim/method/model.h"

namespace tumble {

/// Changes every number of the bodies' start – place, attitude, velocities – by a unit in the last
/// place of its vector's size up, down or not at all.
void nudge(WorldDef& world, Random& random);

}  // namespace tumble
