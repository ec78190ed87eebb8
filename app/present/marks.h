// Marks where bodies were hit.
#pragma once

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// Rings at the hits up to t [s] with "t = 0.631 s" and "j = 168.3 N·s": the largest first, as many
/// as find room on the page.
void addImpacts(const Scene& scene, const Recording& recording, double t, double aspect,
                Picture& picture);

}  // namespace tumble
