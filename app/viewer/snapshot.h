// The window's page without a window.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "app/scene/scene.h"
#include "render/renderer.h"

namespace tumble {

/// What a user does before a page is drawn.
struct Deed {
  Eigen::Vector2f pointer = {-1.0f, -1.0f};  ///< [px]
  bool pressed = false;                      ///< the left button
  float wheel = 0.0f;                        ///< up
  std::string typed = {};
  std::string dropped = {};  ///< a file
  double seconds = 0.0;      ///< that pass before the page
};

/// The page as it looks with the scene open, paused at the given share of its duration, after some
/// deeds, one a page. Needs a current context; the list shows this scene alone, so that other demos
/// do not change the image.
Image viewerSnapshot(Renderer& renderer, const Scene& scene, double share, int width, int height,
                     std::span<const Deed> deeds = {});

}  // namespace tumble
