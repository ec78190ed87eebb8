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
  return instance.position.y() - below;
}

double reachOf(const Instance& instance) {
  const Eigen::Vector3d& half = instance.scale;
  if (instance.form == Form::Sphere) return half.x();
  return instance.form == Form::Box ? half.norm() : std::hypot(half.x(), half.y());
}

}  // namespace tumble
