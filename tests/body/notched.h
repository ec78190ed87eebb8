// Polyhedra with notches, for tests: letters, a comb, a star, and a ball with bumps.
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

/// A ball of 4 n (n − 1) triangles with bumps, as a scan would be.
inline Raw scan(int n, double bump) {
  Raw raw{{{0, 0, 1.3}}, {}};
  const double half = 3.14159265358979323846;
  for (int i = 1; i < n; ++i)
    for (int k = 0; k < 2 * n; ++k) {
      const double a = half * i / n, b = half * k / n;
      const double r = 1.0 + bump * (std::sin(3 * b) * std::sin(a) + 0.5 * std::cos(5 * a + b)) +
                       0.02 * bump * ((i * 7919 + k * 104729) % 17 - 8);
      raw.points.emplace_back(r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b),
                              1.3 * r * std::cos(a));
    }
  raw.points.emplace_back(0, 0, -1.3);
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

}  // namespace tumble::solids
