// Where the camera stands so that given points fill the image, and where a point lands on it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "render/picture.h"

namespace tumble {

/// Margins of an image as shares of its width (left, right) and height (top, bottom).
struct Margins {
  double left = 0.06, right = 0.06, top = 0.12, bottom = 0.12;
};

/// The camera of given direction that is as near as the points allow: each of them inside the
/// margins.
///   right margin: (p − eye)·r ≤ t (p − eye)·f for all p,  t = aspect tan(fov/2) (1 − 2 margin);
///   likewise left, top, bottom. Linear in the eye, so the nearest eye is found in closed form;
///   along the dimension that has room to spare the points stand in the middle.
/// @param points     world points [m], at least one, such as the corners of the bounding box of a
/// motion
/// @param azimuth    [deg] of the eye about the vertical; 0 looks along −Z, 90 along −X
/// @param elevation  [deg] of the eye above the horizon, in [−90, 90]
/// @param fov        [deg] vertical, in (0, 180)
/// @param aspect     width / height
/// @throws std::invalid_argument without points, or if margins leave no room.
Camera frame(std::span<const Eigen::Vector3d> points, double azimuth, double elevation, double fov,
             double aspect, const Margins& margins = {});

/// A camera and an image size made ready for projecting points.
class Projection {
 public:
  Projection(const Camera& camera, double width, double height);

  /// Place in the image [px]: x to the right, y down, whole numbers at pixel corners; z is the
  /// depth along the line of sight [m]. Nothing for points nearer than the near plane.
  std::optional<Eigen::Vector3d> project(const Eigen::Vector3d& point) const;

  /// Size of one pixel at depth 1 m [m]; proportional to depth.
  double pixelAtUnitDepth() const { return 2.0 * tangent_ / height_; }

  Eigen::Matrix4d matrix() const;  ///< world to clip space of OpenGL
  const Eigen::Vector3d& eye() const { return eye_; }
  const Eigen::Vector3d& right() const { return right_; }
  const Eigen::Vector3d& up() const { return up_; }
  const Eigen::Vector3d& forward() const { return forward_; }
  double near() const {
    return near_;
  }                                    ///< [m] of the near plane: a tenth of the target's distance
  double far() const { return far_; }  ///< [m] of the far plane: six times that distance

 private:
  Eigen::Vector3d eye_, right_, up_, forward_;
  double near_, far_, tangent_;  // tangent of half the vertical field
  double width_, height_;
};

}  // namespace tumble
