// [[soft]]: a box that bends.
#pragma once

#include "app/scene/body.h"

namespace tumble {

/// Expands each [[soft]] to the bodies NAME.0, NAME.1, …, along x first, then y, then z, with the
/// force that joins them, and joints where it is pinned to a body.
void readSofts(Section& root, const Materials& materials, BodyList& bodies, Scene& scene);

}  // namespace tumble
