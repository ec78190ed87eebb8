#include "render/silhouette.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace tumble {

namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Half extents [m] of the box around a body, and the middle of that box, in the body's frame.
std::pair<Vector3d, Vector3d> boxOf(const Instance& body) {
  if (body.form != Form::Facets) return {body.scale, Vector3d::Zero()};
  Eigen::AlignedBox3f box;
  for (const Facets::Corner& corner : body.facets->corners) box.extend(corner.position);
  if (box.isEmpty()) return {Vector3d::Zero(), Vector3d::Zero()};
  return {body.scale.cwiseProduct(0.5 * box.sizes().cast<double>()),
          body.scale.cwiseProduct(box.center().cast<double>())};
}

std::vector<Vector3d> rimOf(const Instance& body, const Projection& projection) {
  constexpr int kSides = 16;
  std::vector<Vector3d> rim;
  if (body.form == Form::Sphere) {
    const double r = body.scale.x() / std::cos(std::numbers::pi / kSides);
    for (int k = 0; k < kSides; ++k) {
      const double turn = 2.0 * std::numbers::pi * k / kSides;
      rim.push_back(body.position +
                    r * (std::cos(turn) * projection.right() + std::sin(turn) * projection.up()));
    }
    return rim;
  }
  constexpr std::size_t kFew = 600;  // corners, of which a silhouette is found at once
  if (body.form == Form::Facets && body.facets->corners.size() <= kFew) {
    for (const Facets::Corner& corner : body.facets->corners)
      rim.push_back(body.position +
                    body.orientation * body.scale.cwiseProduct(corner.position.cast<double>()));
    return rim;
  }
  const auto [half, middle] = boxOf(body);
  for (int k = 0; k < 8; ++k) {
    const Vector3d side(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0);
    rim.push_back(body.position + body.orientation * (middle + half.cwiseProduct(side)));
  }
  return rim;
}

}  // namespace

std::vector<int> hullCorners(const std::vector<Vector2d>& points) {
  std::vector<int> order(points.size()), hull;
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](int i) -> const Vector2d& { return points[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::pair(at(a).x(), at(a).y()) < std::pair(at(b).x(), at(b).y());
  });
  for (int chain = 0; chain < 2; ++chain) {
    const std::size_t first = hull.size();
    for (const int i : order) {
      while (hull.size() > first + 1 &&
             cross(at(hull.back()) - at(hull[hull.size() - 2]), at(i) - at(hull.back())) <= 0.0)
        hull.pop_back();
      hull.push_back(i);
    }
    if (hull.size() > first + 1) hull.pop_back();  // the next chain begins with it
    std::reverse(order.begin(), order.end());
  }
  return hull;
}

std::vector<Vector3d> outermost(const std::vector<Vector3d>& points, const Camera& camera) {
  const Projection projection(camera, 1.0, 1.0);
  std::vector<int> corners;
  for (const Vector3d& side : {projection.right(), projection.up()}) {
    std::vector<Vector2d> places;
    for (const Vector3d& point : points)
      places.emplace_back(point.dot(side), point.dot(projection.forward()));
    for (const int corner : hullCorners(places)) corners.push_back(corner);
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::vector<Vector3d> outer;
  for (const int corner : corners) outer.push_back(points[static_cast<std::size_t>(corner)]);
  return outer;
}

bool Silhouette::meets(const AlignedBox2d& other) const {
  // Of every side some corner of the box lies inwards: the one that would be furthest outwards of a
  // box with its corners exchanged.
  return box.intersects(other) && reachesNoSide(other.max(), other.min());
}

bool Silhouette::contains(const AlignedBox2d& other) const {
  return !corners.empty() && reachesNoSide(other.min(), other.max());
}

bool Silhouette::reachesNoSide(const Vector2d& low, const Vector2d& high) const {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2d& from = corners[k];
    const Vector2d way = corners[(k + 1) % corners.size()] - from;
    const Vector2d outmost(way.y() > 0.0 ? high.x() : low.x(), way.x() > 0.0 ? low.y() : high.y());
    if (cross(way, outmost - from) < 0.0) return false;
  }
  return true;
}

std::optional<Silhouette> silhouetteOf(const Instance& body, const Projection& projection) {
  Silhouette silhouette;
  std::vector<Vector2d> places;
  for (const Vector3d& point : rimOf(body, projection)) {
    const auto place = projection.project(point);
    if (!place) return {};
    places.emplace_back(place->head<2>());
    silhouette.box.extend(places.back());
  }
  for (const int corner : hullCorners(places))
    silhouette.corners.push_back(places[static_cast<std::size_t>(corner)]);
  silhouette.centre = body.position;
  silhouette.depth = (body.position - projection.eye()).dot(projection.forward());
  silhouette.solid = body.finish == Finish::Solid;
  return silhouette;
}

}  // namespace tumble
