#include "app/present/bands.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tumble {

namespace {

struct Point {
  Facets::Corner corner;
  double value = 0.0;
};

// Where the quantity is `level` between two corners; the same from both sides.
Point between(const Point& a, const Point& b, double level) {
  const Point &low = a.value < b.value ? a : b, &high = a.value < b.value ? b : a;
  const float u = static_cast<float>((level - low.value) / (high.value - low.value));
  const auto mix = [u](const Eigen::Vector3f& p, const Eigen::Vector3f& q) {
    return Eigen::Vector3f(p + u * (q - p));
  };
  return {{mix(low.corner.position, high.corner.position),
           mix(low.corner.normal, high.corner.normal), low.corner.toEdge},
          level};
}

// The part of a convex polygon where sign · (value − level) ≥ 0 (Sutherland and Hodgman).
std::vector<Point> kept(const std::vector<Point>& polygon, double level, double sign) {
  std::vector<Point> part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const bool in = sign * (a.value - level) >= 0.0, next = sign * (b.value - level) >= 0.0;
    if (in) part.push_back(a);
    if (in != next) part.push_back(between(a, b, level));
  }
  return part;
}

void addFan(const std::vector<Point>& polygon, Facets& facets) {
  for (std::size_t k = 2; k < polygon.size(); ++k)
    for (const std::size_t at : {std::size_t{0}, k - 1, k})
      facets.corners.push_back(polygon[at].corner);
}

}  // namespace

std::vector<Facets> inBands(const Facets& facets, std::span<const double> values, double top,
                            int bands) {
  std::vector<Facets> parts(static_cast<std::size_t>(bands));
  const double width = top / bands;
  const auto bandOf = [&](double value) {
    return std::clamp(static_cast<int>(value / width), 0, bands - 1);
  };
  for (std::size_t n = 0; n + 2 < facets.corners.size(); n += 3) {
    const auto [low, high] = std::minmax({values[n], values[n + 1], values[n + 2]});
    const int first = bandOf(low), last = bandOf(high);
    const auto corner = facets.corners.begin() + static_cast<std::ptrdiff_t>(n);
    if (first == last) {
      std::vector<Facets::Corner>& whole = parts[static_cast<std::size_t>(last)].corners;
      whole.insert(whole.end(), corner, corner + 3);
      continue;
    }
    std::vector<Point> rest;
    for (std::size_t k = n; k < n + 3; ++k) rest.push_back({facets.corners[k], values[k]});
    for (int band = first; band < last; ++band) {
      const double level = (band + 1) * width;
      addFan(kept(rest, level, -1.0), parts[static_cast<std::size_t>(band)]);
      rest = kept(rest, level, 1.0);
    }
    addFan(rest, parts[static_cast<std::size_t>(last)]);
  }
  for (Facets& part : parts) {
    part.reach = facets.reach;
    part.thickness = facets.thickness;
  }
  return parts;
}

}  // namespace tumble
