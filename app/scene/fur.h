// [[fur]]: strands that grow on a body.
#pragma once

#include "app/scene/body.h"

namespace tumble {

/// Expands each [[fur]] to the bodies NAME.S.P, point P of strand S, appended strand by strand;
/// each strand has a force that joins its points, and two points at its root that stand, or go with
/// the body it grows on.
void readFurs(Section& root, const Materials& materials, BodyList& bodies, Scene& scene);

}  // namespace tumble
