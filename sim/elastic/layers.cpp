#include "sim/elastic/layers.h"

#include <algorithm>
#include <cmath>

namespace tumble {

double LayerPair::energy() const {
  const double pressed = std::max(0.0, thickness - distance);
  return 0.5 * stiffness * pressed * pressed;
}

Layers::Layers(std::span<const std::shared_ptr<const ElasticBody>> bodies) {
  for (const auto& body : bodies)
    if (body->sheet.thickness > 0.0 && body->sheet.stiffness > 0.0) addCloth(*body);
}

void Layers::addCloth(const ElasticBody& body) {
  const Sheet& sheet = body.sheet;
  const int firstPoint = static_cast<int>(points_.size());
  firsts_.push_back(firstPoint);
  points_.insert(points_.end(), body.bodies.begin(), body.bodies.end());
  clothOf_.resize(points_.size(), static_cast<int>(cloths_.size()));
  for (const Eigen::Vector2d& p : sheet.flat) flat_.emplace_back(p.x(), p.y(), 0.0);
  const auto numberOf = [&](int i) {
    const auto at = std::lower_bound(body.bodies.begin(), body.bodies.end(), i);
    return firstPoint + static_cast<int>(at - body.bodies.begin());
  };
  Cloth cloth{.firstTriangle = static_cast<int>(triangles_.size()),
              .firstPatch = patches_,
              .tree = {},
              .thickness = sheet.thickness,
              .stiffness = sheet.stiffness};
  std::vector<Aabb> boxes;
  std::vector<char> hasPoint(body.bodies.size(), false);
  std::vector<std::pair<int, int>> edges;
  for (const std::array<int, 3>& corners : sheet.triangles) {
    Triangle triangle;
    for (int k = 0; k < 3; ++k) triangle.points[k] = numberOf(corners[k]);
    const auto [a, b, c] = triangle.points;
    Eigen::Matrix2d sides;
    sides << (flat_[b] - flat_[a]).head<2>(), (flat_[c] - flat_[a]).head<2>();
    triangle.unwoven = sides.inverse();
    triangle.middle = (flat_[a] + flat_[b] + flat_[c]) / 3.0;
    for (const int p : triangle.points)
      triangle.radius = std::max(triangle.radius, (flat_[p] - triangle.middle).norm());
    boxes.push_back({flat_[a].cwiseMin(flat_[b]).cwiseMin(flat_[c]),
                     flat_[a].cwiseMax(flat_[b]).cwiseMax(flat_[c])});
    for (int k = 0; k < 3; ++k) {
      char& known = hasPoint[triangle.points[k] - firstPoint];
      triangle.ownsPoint[k] = !known;
      known = true;
      edges.emplace_back(std::minmax(triangle.points[k], triangle.points[(k + 1) % 3]));
    }
    triangles_.push_back(triangle);
  }
  // An edge is its first triangle's.
  std::vector<std::pair<std::pair<int, int>, int>> sorted;
  for (std::size_t e = 0; e < edges.size(); ++e) sorted.emplace_back(edges[e], static_cast<int>(e));
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t e = 0; e < sorted.size(); ++e)
    if (e == 0 || sorted[e].first != sorted[e - 1].first)
      triangles_[cloth.firstTriangle + sorted[e].second / 3].ownsEdge[sorted[e].second % 3] = true;
  cloth.tree = BoxTree(boxes);
  patches_ += static_cast<int>(cloth.tree.nodes().size());
  cloths_.push_back(std::move(cloth));
}

}  // namespace tumble
