#include "render/picture.h"

#include <algorithm>
#include <cmath>

namespace tumble {

double lowestPoint(const Instance& instance) {
  const Eigen::Vector3d up_B = instance.orientation.conjugate() * Eigen::Vector3d::UnitY();
  const Eigen::Vector3d& half = instance.scale;
  double below = half.x();
  if (instance.form == Form::Box) below = up_B.cwiseAbs().dot(half);
  if (instance.form == Form::Cylinder)
    below = std::abs(up_B.y()) * half.y() +
            half.x() * std::sqrt(std::max(0.0, 1.0 - up_B.y() * up_B.y()));
  if (instance.form == Form::Facets) {
    below = 0.0;
    const Eigen::Vector3f down = -(half.asDiagonal() * up_B).cast<float>();
    for (const Facets::Corner& corner : instance.facets->corners)
      below = std::max(below, static_cast<double>(down.dot(corner.position)));
  }
  if (instance.form == Form::Ellipsoid) below = up_B.cwiseProduct(half).norm();
  return instance.position.y() - below;
}

double reachOf(const Instance& instance) {
  const Eigen::Vector3d& half = instance.scale;
  if (instance.form == Form::Sphere) return half.x();
  if (instance.form == Form::Facets) return half.maxCoeff() * instance.facets->reach;
  if (instance.form == Form::Ellipsoid) return half.maxCoeff();
  return instance.form == Form::Box ? half.norm() : std::hypot(half.x(), half.y());
}

Eigen::AlignedBox3d boxAround(const Eigen::Vector3d& centre, double radius) {
  return {(centre.array() - radius).matrix(), (centre.array() + radius).matrix()};
}

double thicknessOf(const Instance& instance) {
  const double scale = instance.scale.minCoeff();
  return instance.form == Form::Facets ? scale * instance.facets->thickness : scale;
}

}  // namespace tumble
