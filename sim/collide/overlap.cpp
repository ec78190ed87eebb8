#include "sim/collide/overlap.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

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

/// Nearest point to the origin of the flat through some corners, if it lies between them.
bool nearestBetween(const std::vector<Vec3>& corners, Vec3& nearest) {
  const int n = static_cast<int>(corners.size()) - 1;
  nearest = corners[0];
  if (n == 0) return true;
  MatX edges(3, n);
  for (int k = 0; k < n; ++k) edges.col(k) = corners[static_cast<std::size_t>(k) + 1] - corners[0];
  const Eigen::FullPivLU<MatX> gram(edges.transpose() * edges);
  if (!gram.isInvertible()) return false;
  const VecX weights = gram.solve(-edges.transpose() * corners[0]);
  if (weights.minCoeff() < 0.0 || weights.sum() > 1.0) return false;
  nearest += edges * weights;
  return true;
}

/// Nearest point of a simplex to the origin; keeps the corners that carry it.
Vec3 nearestOf(std::vector<Vec3>& corners) {
  Vec3 best = Vec3::Zero();
  std::vector<Vec3> kept;
  for (unsigned subset = 1; subset < 1u << corners.size(); ++subset) {
    std::vector<Vec3> chosen;
    for (std::size_t k = 0; k < corners.size(); ++k)
      if (subset >> k & 1u) chosen.push_back(corners[k]);
    Vec3 nearest;
    if (!nearestBetween(chosen, nearest)) continue;
    if (!kept.empty() && nearest.squaredNorm() >= best.squaredNorm()) continue;
    best = nearest;
    kept = std::move(chosen);
  }
  corners = std::move(kept);
  return best;
}

}  // namespace

bool overlap(const Part& a, const Part& b) {
  const double size = sizeOf(a) + sizeOf(b);
  Vec3 v = middleOf(a) - middleOf(b);
  if (v.norm() < kRounding * size) return true;
  std::vector<Vec3> corners;
  for (int step = 0; step < 100; ++step) {
    // The outermost point of the difference towards the origin; if it does not reach it, a plane
    // parts the two.
    const Vec3 corner = farthest(a, -v) - farthest(b, v);
    if (v.dot(corner) > 0.0) return false;
    corners.push_back(corner);
    v = nearestOf(corners);
    if (corners.size() == 4 || v.norm() < 1e-3 * kRounding * size) return true;
  }
  return false;
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
