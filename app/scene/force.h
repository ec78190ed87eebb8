// [[force]]: wind, drag, point forces, springs and fields.
#pragma once

#include "app/scene/body.h"

namespace tumble {

void readForces(Section& root, const BodyList& bodies, std::vector<Force>& forces);

}  // namespace tumble
