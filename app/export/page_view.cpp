#include "app/export/page_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/present/framing.h"
#include "render/camera.h"
#include "render/silhouette.h"

namespace tumble {

namespace {

// Azimuth and elevation [deg] of the eye as its target sees it.
std::pair<double, double> directionOf(const CameraKey& key) {
  const Vec3 away = (key.eye - key.target).normalized();
  return {std::atan2(away.x(), away.z()) * 180.0 / std::numbers::pi,
          std::asin(std::clamp(away.y(), -1.0, 1.0)) * 180.0 / std::numbers::pi};
}

}  // namespace

PageView pageView(const Scene& scene, const Recording& recording) {
  Scene seen = scene;
  CameraView& view = seen.camera;
  if (!view.keys.empty()) {
    std::tie(view.azimuth, view.elevation) = directionOf(view.keys.front());
    view.fov = view.keys.front().fov;
  }
  const SeenRun run{seen, recording};
  const Framing framing = framingOf(seen, {{run}});
  return {framing.camera, outermost(shownPoints(run, framing), framing.camera)};
}

}  // namespace tumble
