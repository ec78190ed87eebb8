#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace tumble {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Interval of eye coordinates along one image axis, as a function of the eye's depth z:
/// from  low + tangentLow·z  to  high − tangentHigh·z.
struct Slab {
  double low, high, tangentLow, tangentHigh;
  /// The largest depth of the eye at which the interval is not empty.
  double depth() const { return (high - low) / (tangentLow + tangentHigh); }
  double middle(double z) const { return 0.5 * (low + tangentLow * z + high - tangentHigh * z); }
};

}  // namespace

Camera frame(std::span<const Eigen::Vector3d> points, double azimuth, double elevation, double fov,
             double aspect, const Margins& margins) {
  if (points.empty()) throw std::invalid_argument("a camera needs points to frame");
  if (!(margins.left + margins.right < 0.95 && margins.top + margins.bottom < 0.95))
    throw std::invalid_argument("margins leave no room for the picture");

  // Image axes, from the direction of sight alone.
  const double a = azimuth * kDegree, e = elevation * kDegree;
  const Eigen::Vector3d forward(-std::sin(a) * std::cos(e), -std::sin(e),
                                -std::cos(a) * std::cos(e));
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitY()).normalized();
  const Eigen::Vector3d up = right.cross(forward);

  // Each point bounds the eye (x, y, z in image axes) from four sides: t z + x ≥ p·r − … as a slab.
  const double t = std::tan(0.5 * fov * kDegree);
  const double tRight = aspect * t * (1.0 - 2.0 * margins.right),
               tLeft = aspect * t * (1.0 - 2.0 * margins.left);
  const double tTop = t * (1.0 - 2.0 * margins.top), tBottom = t * (1.0 - 2.0 * margins.bottom);
  const double infinity = std::numeric_limits<double>::infinity();
  Slab across{-infinity, infinity, tRight, tLeft}, upright{-infinity, infinity, tTop, tBottom};
  double nearest = infinity, farthest = -infinity;
  double size = 0.0;
  for (const Eigen::Vector3d& point : points) {
    size = std::max(size, (point - points[0]).norm());
    const double x = point.dot(right), y = point.dot(up), z = point.dot(forward);
    across.low = std::max(across.low, x - tRight * z);
    across.high = std::min(across.high, x + tLeft * z);
    upright.low = std::max(upright.low, y - tTop * z);
    upright.high = std::min(upright.high, y + tBottom * z);
    nearest = std::min(nearest, z);
    farthest = std::max(farthest, z);
  }

  // As near as both slabs allow; a single point gets a metre of distance.
  const double limit = std::min(across.depth(), upright.depth());
  const double room = 1e-3 * std::min(1.0, size);
  const double depth = std::min(limit, nearest - std::max(room, 0.05 * (farthest - nearest)));
  const double z = points.size() == 1 ? nearest - 1.0 : depth;
  const Eigen::Vector3d eye = right * across.middle(z) + up * upright.middle(z) + forward * z;
  return {eye, eye + forward * (0.5 * (nearest + farthest) - z), fov, azimuth};
}

Projection::Projection(const Camera& camera, double width, double height)
    : eye_(camera.eye),
      tangent_(std::tan(0.5 * camera.fov * kDegree)),
      width_(width),
      height_(height) {
  const Eigen::Vector3d sight = camera.target - camera.eye;
  const double distance = sight.norm();
  if (!(distance > 0.0)) throw std::invalid_argument("the camera's eye and target are one point");
  forward_ = sight / distance;
  // Straight down, the top of an unturned image is −Z.
  const Eigen::Vector3d across = forward_.cross(Eigen::Vector3d::UnitY());
  const double a = camera.azimuth * kDegree;
  right_ = across.norm() > 1e-6 ? across.normalized().eval()
                                : Eigen::Vector3d(std::cos(a), 0.0, -std::sin(a));
  up_ = right_.cross(forward_);
  near_ = 0.1 * distance;
  far_ = 6.0 * distance;
}

std::optional<Eigen::Vector3d> Projection::project(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d sight = point - eye_;
  const double depth = sight.dot(forward_);
  if (!(depth > near_)) return std::nullopt;
  const double scale = 1.0 / (pixelAtUnitDepth() * depth);
  return Eigen::Vector3d(0.5 * width_ + sight.dot(right_) * scale,
                         0.5 * height_ - sight.dot(up_) * scale, depth);
}

Eigen::Matrix4d Projection::matrix() const {
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.row(0) << right_.transpose(), -right_.dot(eye_);
  view.row(1) << up_.transpose(), -up_.dot(eye_);
  view.row(2) << -forward_.transpose(), forward_.dot(eye_);
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = height_ / (tangent_ * width_);
  clip(1, 1) = 1.0 / tangent_;
  clip(2, 2) = (far_ + near_) / (near_ - far_);
  clip(2, 3) = 2.0 * far_ * near_ / (near_ - far_);
  clip(3, 2) = -1.0;
  return clip * view;
}

}  // namespace tumble
