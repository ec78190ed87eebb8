// [[joint]]: what holds two bodies together.
#pragma once

#include "app/scene/body.h"

namespace tumble {

void readJoints(Section& root, BodyList& bodies, std::vector<JointDef>& joints);

}  // namespace tumble
