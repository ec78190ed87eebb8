#include "app/viewer/orbit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tumble {

using std::numbers::pi;

Orbit Orbit::of(const Camera& camera) {
  const Eigen::Vector3d back = camera.eye - camera.target;
  Orbit orbit;
  orbit.target = camera.target;
  orbit.distance = back.norm();
  const bool upright = std::hypot(back.x(), back.z()) <= 1e-6 * orbit.distance;
  orbit.azimuth = upright ? camera.azimuth * pi / 180.0 : std::atan2(back.x(), back.z());
  orbit.elevation = std::asin(back.y() / orbit.distance);
  orbit.fov = camera.fov;
  return orbit;
}

Camera Orbit::camera() const {
  const Eigen::Vector3d back = {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                std::cos(elevation) * std::cos(azimuth)};
  return {.eye = target + distance * back,
          .target = target,
          .fov = fov,
          .azimuth = azimuth * 180.0 / pi};
}

void Orbit::turn(double dx, double dy, double height) {
  azimuth = std::remainder(azimuth - pi * dx / height, 2.0 * pi);
  elevation = std::clamp(elevation + pi * dy / height, -1.5, 1.5);
}

void Orbit::zoom(double notches) {
  distance *= std::pow(0.9, notches);
}

void Orbit::pan(double dx, double dy, double height) {
  const double metresPerPixel = 2.0 * distance * std::tan(fov * pi / 360.0) / height;
  const Eigen::Vector3d right = {std::cos(azimuth), 0.0, -std::sin(azimuth)};
  const Eigen::Vector3d up = {-std::sin(elevation) * std::sin(azimuth), std::cos(elevation),
                              -std::sin(elevation) * std::cos(azimuth)};
  target += metresPerPixel * (dy * up - dx * right);
}

}  // namespace tumble
