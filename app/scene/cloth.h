// [[cloth]]: a rectangle of points and what bends between them.
#pragma once

#include "app/scene/body.h"

namespace tumble {

/// Expands each [[cloth]] to the bodies NAME.0, NAME.1, …, appended in order, row by row, with the
/// force that joins them, and joints where it is pinned to a body.
void readCloths(Section& root, const Materials& materials, BodyList& bodies, Scene& scene);

}  // namespace tumble
