// [[expect]]
#pragma once

#include "app/scene/section.h"

namespace tumble {

/// Reads what a scene claims by formulas; whether these are formulas is for those who evaluate
/// them.
void readExpects(Section& root, Scene& scene);

}  // namespace tumble
