// A camera that circles its target.
#pragma once

#include "render/picture.h"

namespace tumble {

/// A camera in polar coordinates about its target.
struct Orbit {
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  ///< [m]
  double distance = 8.0;                             ///< [m]
  double azimuth = 0.0;    ///< [rad] about the vertical; 0 looks along −Z
  double elevation = 0.2;  ///< [rad] of the eye above the horizon
  double fov = 24.0;       ///< [deg] vertical

  bool operator==(const Orbit&) const = default;

  static Orbit of(const Camera& camera);
  Camera camera() const;

  /// Turns by a mouse path [px], a full image height being half a turn. Stops short of the poles.
  void turn(double dx, double dy, double height);
  /// Moves nearer by tenths of the distance.
  void zoom(double notches);
  /// Shifts the target in the image plane by a mouse path [px]; the target stays under the mouse.
  void pan(double dx, double dy, double height);
};

}  // namespace tumble
