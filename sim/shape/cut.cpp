#include "sim/shape/cut.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "sim/math/orientation.h"
#include "sim/shape/folds.h"

namespace tumble::cut {

using Whole = boost::multiprecision::cpp_int;

/// A point in whole numbers: (x, y, z) / w, w > 0.
struct Fraction3 {
  Whole x, y, z, w;
};

namespace {

/// The number x as mantissa · 2^exponent.
Whole mantissa(double x, int& exponent) {
  const double m = std::frexp(x, &exponent);
  exponent -= 53;
  return static_cast<long long>(std::ldexp(m, 53));
}

Fraction3 exactly(const Vec3& p) {
  int e[3];
  Whole m[3];
  for (int k = 0; k < 3; ++k) m[k] = mantissa(p[k], e[k]);
  int least = 0;
  for (int k = 0; k < 3; ++k)
    if (m[k] != 0) least = std::min(least, e[k]);
  for (int k = 0; k < 3; ++k)
    if (m[k] != 0) m[k] <<= e[k] - least;
  return {m[0], m[1], m[2], Whole(1) << -least};
}

/// A point to all its digits. To ask of three costs as much as to look at a hundred triangles, and
/// more by the square of their digits, as products do.
Fraction3 exactly(const Points& points, int p) {
  constexpr long kLook = 33, kDigits = 5;  // triangles; digits of 64 bits, squared, that make one
  const auto& known = points.exact[static_cast<std::size_t>(p)];
  Fraction3 x = known ? *known : exactly(points.at[static_cast<std::size_t>(p)]);
  long most = 0;
  for (const Whole* part : {&x.x, &x.y, &x.z, &x.w})
    most = std::max(most, static_cast<long>(part->backend().size()));
  points.looks += kLook + most * most / kDigits;
  return x;
}

/// Divided by what all four have in common.
Fraction3 reduced(Fraction3 p) {
  const Whole common = gcd(gcd(p.x, p.y), gcd(p.z, p.w));
  if (common > 1) p.x /= common, p.y /= common, p.z /= common, p.w /= common;
  return p;
}

double quotient(const Whole& x, const Whole& w) {
  return boost::multiprecision::cpp_rational(x, w).convert_to<double>();
}

int signOf(const Whole& x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

/// Far more than rounding may change a height or a turn by.
constexpr double kSure = 1e-9;
/// Corners in line, each rounded, turn by no more, of their size times the lengths between them.
constexpr double kNoise = 4e-15;
/// Of size × area: a volume below it may be rounding alone.
constexpr double kThin = 1e-12;

const Vec3& at(const Points& points, int p) {
  return points.at[static_cast<std::size_t>(p)];
}

/// A plane in whole numbers: n·p − d w for a point p / w, of the sign of its height.
struct WholePlane {
  Fraction3 n;  ///< w is d

  explicit WholePlane(const CutPlane& plane) {
    const Fraction3 a = exactly(plane.a), b = exactly(plane.b), c = exactly(plane.c);
    const auto along = [&](const Fraction3& p) {
      return Fraction3{p.x * a.w - a.x * p.w, p.y * a.w - a.y * p.w, p.z * a.w - a.z * p.w, 1};
    };
    const Fraction3 u = along(b), v = along(c);
    n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x, 0};
    n.w = n.x * a.x + n.y * a.y + n.z * a.z;
    n.x *= a.w, n.y *= a.w, n.z *= a.w;
    n = reduced(n);
  }
  Whole height(const Fraction3& p) const { return n.x * p.x + n.y * p.y + n.z * p.z - n.w * p.w; }
};

/// The corner where the edge from p to q passes the plane.
int crossing(Points& points, int p, int q, const CutPlane& plane, const WholePlane* exact) {
  const Vec3 from = at(points, p), to = at(points, q);
  if (!exact) {
    const double h = plane.height(from), k = plane.height(to);
    points.at.push_back(from + (h / (h - k)) * (to - from));
    points.exact.emplace_back();
  } else {
    // (h q − k p) / (h − k) of points as they are, h and k heights times their w.
    const Fraction3 a = exactly(points, p), b = exactly(points, q);
    Whole h = exact->height(a), k = exact->height(b);
    if (h < k) h = -h, k = -k;
    const Fraction3 x =
        reduced({h * b.x - k * a.x, h * b.y - k * a.y, h * b.z - k * a.z, h * b.w - k * a.w});
    points.at.emplace_back(quotient(x.x, x.w), quotient(x.y, x.w), quotient(x.z, x.w));
    points.exact.push_back(std::make_shared<const Fraction3>(x));
  }
  return static_cast<int>(points.at.size()) - 1;
}

}  // namespace

bool isThin(const Points& points, const Surface& surface, double share) {
  double area = 0.0, far = 0.0;
  for (const auto& [corner, face] : surface) {
    const Vec3 &a = at(points, corner[0]), &b = at(points, corner[1]), &c = at(points, corner[2]);
    area += twiceArea(a, b, c).norm();
    far = std::max({far, a.norm(), b.norm(), c.norm()});
  }
  return std::abs(sixfoldVolume(points, surface)) <= share * far * area;
}

namespace {

/// Sorts triangles to the two sides of a plane, and splits those that cross it.
class Splitter {
 public:
  Splitter(Points& points, const CutPlane& plane, double tolerance)
      : points_(points), plane_(plane), tolerance_(tolerance) {
    if (tolerance == 0.0) exact_.emplace(plane);
  }

  void add(const Triangle& t, Halves& halves) {
    int side[3], above = 0, below = 0;
    for (int k = 0; k < 3; ++k) {
      side[k] = sideOf(t.corner[static_cast<std::size_t>(k)]);
      above += side[k] > 0 ? 1 : 0;
      below += side[k] < 0 ? 1 : 0;
    }
    if (above == 0 && below == 0) {
      within_.push_back(t);
    } else if (above == 0) {
      halves.below.push_back(t);
    } else if (below == 0) {
      halves.above.push_back(t);
    } else {
      split(t, side, halves);
    }
  }

  /// Sorts the triangles in the plane.
  void addWithin(Halves& halves) const {
    const std::vector<int> side = sidesWithin(points_, within_, plane_.n);
    for (std::size_t t = 0; t < within_.size(); ++t)
      (side[t] < 0 ? halves.below : halves.above).push_back(within_[t]);
  }

 private:
  int sideOf(int p) {
    const auto [known, fresh] = side_.emplace(p, 0);
    if (fresh) known->second = askSideOf(p);
    return known->second;
  }

  /// +1 above, −1 below, 0 on the plane: exactly, or to the tolerance.
  int askSideOf(int p) const {
    const double height = plane_.height(at(points_, p));
    if (!exact_ && std::abs(height) <= tolerance_) {
      points_.snapped = std::max(points_.snapped, std::abs(height));
      return 0;
    }
    if (!exact_) return height > 0.0 ? 1 : -1;
    const double size = (at(points_, p) - plane_.a).norm() + plane_.a.norm();
    if (std::abs(height) > kSure * size) return height > 0.0 ? 1 : -1;
    if (!points_.exact[static_cast<std::size_t>(p)])
      return orientation(plane_.a, plane_.b, plane_.c, at(points_, p));
    return signOf(exact_->height(exactly(points_, p)));
  }

  int between(int p, int q) {
    const auto [known, fresh] = crossing_.emplace(std::minmax(p, q), 0);
    if (fresh) known->second = crossing(points_, p, q, plane_, exact_ ? &*exact_ : nullptr);
    return known->second;
  }

  void split(const Triangle& t, const int* side, Halves& halves) {
    // The outline on either side, new corners between.
    std::vector<int> half[2];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      const int p = t.corner[k], q = t.corner[next];
      if (side[k] <= 0) half[0].push_back(p);
      if (side[k] >= 0) half[1].push_back(p);
      if (side[k] * side[next] >= 0) continue;
      const int x = between(p, q);
      half[0].push_back(x);
      half[1].push_back(x);
    }
    for (int k = 0; k < 2; ++k)
      for (std::size_t m = 1; m + 1 < half[k].size(); ++m)
        (k == 0 ? halves.below : halves.above)
            .push_back({{half[k][0], half[k][m], half[k][m + 1]}, t.face});
  }

  Points& points_;
  const CutPlane& plane_;
  double tolerance_;
  std::optional<WholePlane> exact_;
  std::vector<Triangle> within_;  // the plane
  std::map<int, int> side_;
  std::map<std::pair<int, int>, int> crossing_;
};

}  // namespace

CutPlane planeThrough(const Vec3& a, const Vec3& b, const Vec3& c) {
  CutPlane plane{a, b, c};
  plane.n = twiceArea(a, b, c).normalized();
  plane.d = plane.n.dot(a);
  return plane;
}

double sixfoldVolume(const Points& points, const Surface& surface) {
  if (surface.empty()) return 0.0;
  const Vec3 foot = at(points, surface[0].corner[0]);
  double sum = 0.0;
  for (const auto& [corner, face] : surface) {
    const Vec3 &a = at(points, corner[0]), &b = at(points, corner[1]), &c = at(points, corner[2]);
    sum += (a - foot).dot(twiceArea(a, b, c));
  }
  return sum;
}

std::vector<Vec3> cornersOf(const Points& points, const Surface& surface) {
  std::vector<int> list;
  for (const auto& [corner, face] : surface) list.insert(list.end(), corner.begin(), corner.end());
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  std::vector<Vec3> corners;
  for (const int p : list) corners.push_back(at(points, p));
  return corners;
}

double mostNoise(double far) {
  return kNoise * (3.0 * far) * (4.0 * far);
}

double turn(const Points& points, int a, int b, int c, int axis, bool exact) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Vec3 &p = at(points, a), &q = at(points, b), &r = at(points, c);
  const double left = (q[u] - p[u]) * (r[v] - p[v]), right = (q[v] - p[v]) * (r[u] - p[u]);
  const double size = p.norm() + q.norm() + r.norm();
  const double noise = kNoise * size * ((q - p).lpNorm<1>() + (r - p).lpNorm<1>());
  const double doubt = kSure * (std::abs(left) + std::abs(right) + kSure * size * size);
  if (!exact) return std::abs(left - right) <= noise ? 0.0 : left - right;
  if (std::abs(left - right) > doubt) return left - right;
  const auto of = [](const Fraction3& x, int axis) -> const Whole& {
    return axis == 0 ? x.x : axis == 1 ? x.y : x.z;
  };
  const Fraction3 x = exactly(points, a), y = exactly(points, b), z = exactly(points, c);
  const Whole &xu = of(x, u), &xv = of(x, v), &yu = of(y, u), &yv = of(y, v), &zu = of(z, u),
              &zv = of(z, v);
  return signOf(x.w * (yu * zv - yv * zu) - xu * (y.w * zv - yv * z.w) +
                xv * (y.w * zu - yu * z.w));
}

Halves halve(Points& points, const Surface& surface, const CutPlane& plane, double tolerance) {
  Halves halves;
  Splitter splitter(points, plane, tolerance);
  for (const Triangle& t : surface) splitter.add(t, halves);
  splitter.addWithin(halves);
  // Edges below that have lost their other side bound the cut.
  std::map<std::pair<int, int>, int> open;
  for (const auto& [corner, face] : halves.below)
    for (std::size_t k = 0; k < 3; ++k) {
      const int p = corner[k], q = corner[(k + 1) % 3];
      ++open[{p, q}];
      --open[{q, p}];
    }
  std::vector<std::array<int, 2>> edges;
  for (const auto& [edge, count] : open)
    for (int k = 0; k < count; ++k) edges.push_back({edge.second, edge.first});
  for (Triangle& t : fill(points, edges, plane.n, tolerance == 0.0)) {
    halves.below.push_back(t);
    std::swap(t.corner[1], t.corner[2]);
    halves.above.push_back(t);
  }
  return halves;
}

std::vector<Surface> pieces(const Points& points, const Surface& surface) {
  std::vector<int> up(surface.size());
  std::iota(up.begin(), up.end(), 0);
  const auto root = [&](int i) {
    while (up[static_cast<std::size_t>(i)] != i)
      i = up[static_cast<std::size_t>(i)] =
          up[static_cast<std::size_t>(up[static_cast<std::size_t>(i)])];
    return i;
  };
  const auto join = [&](int i, int j) {
    const int p = root(i), q = root(j);
    up[static_cast<std::size_t>(std::max(p, q))] = std::min(p, q);
  };
  // A triangle at an edge, which it runs through from the lower to the higher number, or back.
  struct Side {
    int triangle, way;
  };
  std::map<std::pair<int, int>, std::vector<Side>> sides;
  for (std::size_t t = 0; t < surface.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int p = surface[t].corner[k], q = surface[t].corner[(k + 1) % 3];
      sides[std::minmax(p, q)].push_back({static_cast<int>(t), p < q ? 1 : -1});
    }
  for (const auto& [edge, at] : sides)
    if (at.size() == 2) join(at[0].triangle, at[1].triangle);
  // Two that touch along an edge are apart, if each of them is closed there.
  for (const auto& [edge, at] : sides) {
    std::map<int, int> open;
    for (const Side& side : at) open[root(side.triangle)] += side.way;
    if (std::all_of(open.begin(), open.end(), [](const auto& of) { return of.second == 0; }))
      continue;
    for (const Side& side : at) join(at[0].triangle, side.triangle);
  }
  std::map<int, Surface> found;
  for (std::size_t t = 0; t < surface.size(); ++t)
    found[root(static_cast<int>(t))].push_back(surface[t]);
  std::vector<Surface> apart;
  for (auto& [first, piece] : found) apart.push_back(std::move(piece));
  const bool hollow = std::any_of(apart.begin(), apart.end(), [&](const Surface& piece) {
    return sixfoldVolume(points, piece) < 0.0 && !isThin(points, piece, kThin);
  });
  if (hollow) return {surface};
  return apart;
}

}  // namespace tumble::cut
