// [[array]]: a template body, repeated.
#pragma once

#include "app/scene/body.h"

namespace tumble {

/// Expands each [[array]] to the bodies NAME.0, NAME.1, …, appended in order.
///   kind = "row"    the template's own position plus i·step
///   kind = "tower"  upward from base, the middle of its underside; each stands on the one before
///   kind = "wall"   rows × columns of boxes in running bond; see wall.cpp
///   kind = "rain"   count bodies at random places and orientations; see rain.cpp
/// vary = { restitution = [0, 1], "shape.sphere" = [0.1, 0.2] } makes numbers of the template run
/// evenly from the first copy to the last.
void readArrays(Section& root, const Materials& materials, std::uint64_t seed, Bodies& bodies);

}  // namespace tumble
