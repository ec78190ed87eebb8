// Where a camera with key frames is.
#pragma once

#include <vector>

#include "app/scene/scene.h"
#include "render/picture.h"

namespace tumble {

/// The camera at an instant [s]: through all keys, smoothly, and still before the first and after
/// the last. Hermite's cubic between two keys; the rate at an inner key is that of the chord of
/// its neighbours (Catmull and Rom 1974), at the ends 0.
/// @param keys  at least one, in the order of time
Camera cameraAt(const std::vector<CameraKey>& keys, double t);

}  // namespace tumble
