#include "sim/collide/overlap.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/collide/gjk.h"
#include "sim/math/frames.h"
#include "sim/math/rotation.h"

namespace tumble {
namespace {

constexpr double kRounding = 1e-9;

/// Outermost point of a solid along d, own frame.
Vec3 farthest(const Sphere& s, const Vec3& d) {
  return s.r * d.normalized();
}
Vec3 farthest(const Box& box, const Vec3& d) {
  return (d.array() < 0.0).select(-box.half, box.half);
}
Vec3 farthest(const Cylinder& c, const Vec3& d) {
  const double across = std::sqrt(d.x() * d.x() + d.z() * d.z());
  const double scale = across > 0.0 ? c.r / across : 0.0;
  return {scale * d.x(), d.y() < 0.0 ? -0.5 * c.h : 0.5 * c.h, scale * d.z()};
}

Vec3 farthest(const Capsule& c, const Vec3& d) {
  return Vec3(0.0, d.y() < 0.0 ? -0.5 * c.h : 0.5 * c.h, 0.0) + c.r * d.normalized();
}
Vec3 farthest(const Hull& hull, const Vec3& d) {
  const auto before = [&](const Vec3& p, const Vec3& q) { return d.dot(p) < d.dot(q); };
  const std::vector<Vec3>& points = hull.solid->points;
  return *std::max_element(points.begin(), points.end(), before) - hull.origin;
}

/// A point inside a solid, own frame.
template <class S>
Vec3 middleOf(const S&) {
  return Vec3::Zero();
}
Vec3 middleOf(const Hull& hull) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : hull.solid->points) sum += p;
  return sum / static_cast<double>(hull.solid->points.size()) - hull.origin;
}
Vec3 middleOf(const Part& part) {
  return toWorld(part.pose, std::visit([](const auto& s) { return middleOf(s); }, part.solid));
}

/// Radius [m] of a ball about the middle that holds a part.
double sizeOf(const Part& part) {
  const Shape solid = shapeOf(part);
  if (const Hull* hull = std::get_if<Hull>(&part.solid))
    return boundingRadius(withOrigin(solid, middleOf(*hull) + hull->origin));
  return boundingRadius(solid);
}

/// Outermost point of a part, made smaller by twice the rounding that is let pass.
Vec3 farthest(const Part& part, const Vec3& d) {
  const Mat3 R = rotationMatrix(part.pose.q);
  const Vec3 d_B = R.transpose() * d;
  return std::visit(
      [&](const auto& solid) -> Vec3 {
        const Vec3 middle = middleOf(solid);
        const Vec3 p_B = middle + (1.0 - 2.0 * kRounding) * (farthest(solid, d_B) - middle);
        return part.pose.x + R * p_B;
      },
      part.solid);
}

}  // namespace

bool overlap(const Part& a, const Part& b) {
  const double size = sizeOf(a) + sizeOf(b);
  const Vec3 v = middleOf(a) - middleOf(b);
  if (v.norm() < kRounding * size) return true;
  const auto outermost = [&](const Vec3& n) {
    return gjk::Outermost{farthest(a, -n), farthest(b, n)};
  };
  constexpr double kFiner = 1e-3;
  return gjk::nearest(outermost, v, kFiner * kRounding * size, 0.0).inside;
}

std::pair<int, int> overlappingParts(const Compound& compound) {
  const int count = static_cast<int>(compound.parts.size());
  for (int j = 1; j < count; ++j)
    for (int i = 0; i < j; ++i)
      if (overlap(compound.parts[static_cast<std::size_t>(i)],
                  compound.parts[static_cast<std::size_t>(j)]))
        return {i, j};
  return {-1, -1};
}

}  // namespace tumble
