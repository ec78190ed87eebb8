// The keys `shape` and `orientation` of a body.
#pragma once

#include "app/scene/section.h"
#include "sim/shape/shape.h"

namespace tumble {

/// Nothing, after a complaint, if there is no shape or not exactly one.
std::optional<Shape> readShape(Section& body);

/// [w, x, y, z] of any length but zero, or { axis, degrees }; body to world.
void readOrientation(Section& section, Quat& out);

}  // namespace tumble
