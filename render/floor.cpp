#include "render/floor.h"

#include <cmath>

namespace tumble {
namespace {

/// Where the origin lies between two lines of a grid, in [0, 1); found in double precision.
Eigen::Vector2f shift(const Eigen::Vector3d& origin, double step) {
  if (step <= 0.0) return Eigen::Vector2f::Zero();
  const Eigen::Vector2d q(origin.x() / step, origin.z() / step);
  return Eigen::Vector2d(q.x() - std::floor(q.x()), q.y() - std::floor(q.y())).cast<float>();
}

}  // namespace

FloorDisc::FloorDisc(const std::string& shaders) : program_(shaders, "floor.vert", "floor.frag") {
  program_.use();
  program_.set("aboveMap", 1);
}

void FloorDisc::draw(const Floor& floor, const Stage& stage) const {
  program_.use();
  program_.set("gridShift", shift(stage.origin, floor.grid));
  program_.set("fineShift", shift(stage.origin, floor.fineGrid));
  program_.set("gridStep", Eigen::Vector2d(floor.grid, floor.fineGrid).cast<float>().eval());
  disc_.draw(0, 0, {}, 0, 1);
}

}  // namespace tumble
