// [camera], or several [[camera]]
#pragma once

#include "app/scene/section.h"

namespace tumble {

/// Reads one table, or several of which each has a name. Bodies have been read.
void readCamera(Section& root, Scene& scene);

}  // namespace tumble
