// Polyhedra with notches, for tests: letters, a comb, a star, and what scans are like.
#pragma once

#include <cmath>
#include <vector>

#include "tests/body/solids.h"

namespace tumble::solids {

inline Raw letterU() {
  return prism({{0, 0, 0},
                {3, 0, 0},
                {3, 2, 0},
                {2.5, 2, 0},
                {2.5, 0.5, 0},
                {0.5, 0.5, 0},
                {0.5, 2, 0},
                {0, 2, 0}},
               0.5);
}

inline Raw comb(int teeth) {
  std::vector<Vec3> outline = {{0, 0, 0}, {2.0 * teeth - 1, 0, 0}};
  for (int k = teeth - 1; k >= 0; --k) {
    outline.emplace_back(2.0 * k + 1, 2, 0);
    outline.emplace_back(2.0 * k, 2, 0);
    if (k > 0) outline.emplace_back(2.0 * k, 1, 0), outline.emplace_back(2.0 * k - 1, 1, 0);
  }
  // The first corner on the right stands below the last tooth.
  return prism(outline, 1);
}

inline Raw star(int tips) {
  std::vector<Vec3> outline;
  for (int k = 0; k < 2 * tips; ++k) {
    const double r = k % 2 == 0 ? 1.0 : 0.4, angle = 3.14159265358979323846 * k / tips;
    outline.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
  }
  return prism(outline, 0.3);
}

/// A surface of 4 n (n − 1) triangles about the origin, along meridians and circles of latitude:
/// radius(i, k, direction) from the pole down.
template <class Radius>
Raw around(int n, const Radius& radius) {
  constexpr double kHalf = 3.14159265358979323846;
  Raw raw{{radius(0, 0, Vec3::UnitZ()) * Vec3::UnitZ()}, {}};
  for (int i = 1; i < n; ++i)
    for (int k = 0; k < 2 * n; ++k) {
      const double a = kHalf * i / n, b = kHalf * k / n;
      const Vec3 way(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
      raw.points.push_back(radius(i, k, way) * way);
    }
  raw.points.push_back(-radius(n, 0, -Vec3::UnitZ()) * Vec3::UnitZ());
  const int last = static_cast<int>(raw.points.size()) - 1;
  const auto at = [&](int i, int k) { return 1 + (i - 1) * 2 * n + k % (2 * n); };
  for (int k = 0; k < 2 * n; ++k) {
    raw.faces.push_back({0, at(1, k), at(1, k + 1)});
    raw.faces.push_back({last, at(n - 1, k + 1), at(n - 1, k)});
    for (int i = 1; i + 1 < n; ++i) {
      raw.faces.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      raw.faces.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return raw;
}

/// A ball with bumps, as a scan would be, 1.3 as high as wide.
inline Raw scan(int n, double bump) {
  constexpr double kHalf = 3.14159265358979323846;
  Raw raw = around(n, [&](int i, int k, const Vec3&) {
    if (i == 0 || i == n) return 1.0;
    const double a = kHalf * i / n, b = kHalf * k / n;
    return 1.0 + bump * (std::sin(3 * b) * std::sin(a) + 0.5 * std::cos(5 * a + b)) +
           0.02 * bump * ((i * 7919 + k * 104729) % 17 - 8);
  });
  for (Vec3& p : raw.points) p.z() *= 1.3;
  return raw;
}

/// A body with a head, two ears, two feet and a tail, all of it with fur.
inline Raw bunny(int n) {
  struct Limb {
    Vec3 way;
    double width, height;
  };
  const Limb limbs[] = {{{0.5, 0.0, 0.8}, 0.45, 0.9},    {{0.45, 0.35, 1.0}, 0.12, 1.3},
                        {{0.45, -0.35, 1.0}, 0.12, 1.3}, {{-1.0, 0.0, -0.3}, 0.2, 0.3},
                        {{0.7, 0.4, -0.7}, 0.25, 0.35},  {{0.7, -0.4, -0.7}, 0.25, 0.35}};
  return around(n, [&](int, int, const Vec3& way) {
    double r = 1.0 + 0.01 * std::sin(40 * way.x() + 31 * way.y()) * std::cos(37 * way.z());
    for (const Limb& limb : limbs) {
      const double off = std::atan2(way.cross(limb.way).norm(), way.dot(limb.way)) / limb.width;
      r += limb.height * std::exp(-off * off);
    }
    return r;
  });
}

/// A ball with six spikes.
inline Raw spikes(int n) {
  return around(n, [](int, int, const Vec3& way) {
    double r = 0.3;
    for (int k = 0; k < 3; ++k) r += 2.0 * std::pow(way[k], 20);
    return r;
  });
}

/// A ring of 2 n m triangles about z, its inner radius not everywhere the same.
inline Raw roughRing(int n, int m, double rough) {
  constexpr double kTurn = 2.0 * 3.14159265358979323846;
  Raw raw;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < m; ++k) {
      const double a = kTurn * i / n, b = kTurn * k / m;
      const double r = 0.35 * (1.0 + rough * ((i * 7919 + k * 104729) % 17 - 8) / 8.0);
      const double far = 1.0 + r * std::cos(b);
      raw.points.emplace_back(far * std::cos(a), far * std::sin(a), r * std::sin(b));
      const int j = (i + 1) % n, l = (k + 1) % m;
      raw.faces.push_back({i * m + k, j * m + k, j * m + l});
      raw.faces.push_back({i * m + k, j * m + l, i * m + l});
    }
  return raw;
}

}  // namespace tumble::solids
