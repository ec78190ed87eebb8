// From where a page shows a run that it may be turned in, in a window of any shape.
#pragma once

#include <vector>

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// A direction of sight, and what has to be seen.
struct PageView {
  Camera camera;           ///< that holds the whole motion in the scene's images
  std::vector<Vec3> hold;  ///< [m] points with which, from that direction, a camera holds all
};

/// The whole motion as the scene's camera looks at it; that of its first key, if it has keys.
/// @param recording with at least one sample
PageView pageView(const Scene& scene, const Recording& recording);

}  // namespace tumble
