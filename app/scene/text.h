// [[text]]
#pragma once

#include "app/scene/section.h"

namespace tumble {

/// Reads the words that a scene puts on its pictures. Bodies have been read.
void readFreeTexts(Section& root, Scene& scene);

}  // namespace tumble
