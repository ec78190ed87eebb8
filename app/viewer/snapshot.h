// The window's page without a window.
#pragma once

#include "app/scene/scene.h"
#include "render/renderer.h"

namespace tumble {

/// The page as it looks with the scene open, paused at the given share of its duration. Needs a
/// current context; the list shows this scene alone, so that other demos do not change the image.
Image viewerSnapshot(Renderer& renderer, const Scene& scene, double share, int width, int height);

}  // namespace tumble
