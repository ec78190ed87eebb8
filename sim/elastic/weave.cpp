// A triangle of cloth when flat, and by which numbers its corners make ∂x/∂u and ∂x/∂v.
#include <stdexcept>

#include "sim/elastic/element.h"

namespace tumble {

Weave weaveOf(const Eigen::Vector2d& p0, const Eigen::Vector2d& p1, const Eigen::Vector2d& p2) {
  const Eigen::Vector2d a = p1 - p0, b = p2 - p0;
  const double twice = a.x() * b.y() - a.y() * b.x();
  if (!(twice > 0.0))
    throw std::invalid_argument("a triangle of cloth without area, or turned over");
  // (w_u w_v) = (x1 − x0  x2 − x0) (a b)⁻¹.
  Weave weave;
  weave.area = 0.5 * twice;
  weave.du = Vec4(a.y() - b.y(), b.y(), -a.y(), 0.0) / twice;
  weave.dv = Vec4(b.x() - a.x(), -b.x(), a.x(), 0.0) / twice;
  return weave;
}

Weave weaveOf(double a, double b) {
  return {
      .du = Vec4(-0.5, 0.5, -0.5, 0.5) / a, .dv = Vec4(-0.5, -0.5, 0.5, 0.5) / b, .area = a * b};
}

}  // namespace tumble
