// What a body covers of the page, as a convex polygon.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "render/camera.h"
#include "render/picture.h"

namespace tumble {

/// The corners of the convex hull of points, by number, by the two chains of Andrew (1979):
/// counter-clockwise where y points up. A corner may be told twice if the points stand in a line.
std::vector<int> hullCorners(const std::vector<Eigen::Vector2d>& points);

/// Those of world points [m] that bound what a camera of that direction sees of all of them, from
/// any distance and by any field: the corners of their convex hulls seen from above (across and
/// along the sight) and from the side (up and along it).
std::vector<Eigen::Vector3d> outermost(const std::vector<Eigen::Vector3d>& points,
                                       const Camera& camera);

/// A convex polygon on the page.
struct Silhouette {
  std::vector<Eigen::Vector2d> corners;  ///< [px], as hullCorners tells them
  Eigen::AlignedBox2d box;               ///< [px] around it
  Eigen::Vector3d centre;                ///< [m] of the body
  double depth = 0.0;                    ///< [m] of its centre
  bool solid = true;                     ///< hides what is behind it: no ghost, no glass

  bool meets(const Eigen::AlignedBox2d& other) const;
  bool contains(const Eigen::AlignedBox2d& other) const;

 private:
  /// Whether the corner of a box that is furthest outwards of each side lies within it.
  bool reachesNoSide(const Eigen::Vector2d& low, const Eigen::Vector2d& high) const;
};

/// Of the box around a body in its own frame; of a ball, of its circle; of facets that are few, of
/// their hull. Nothing if some of it is not before the camera.
std::optional<Silhouette> silhouetteOf(const Instance& body, const Projection& projection);

}  // namespace tumble
