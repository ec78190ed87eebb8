#include "sim/math/orientation.h"

#include <array>
#include <cmath>

#include "sim/math/double_double.h"

namespace tumble {
namespace {

/// A sum of doubles without error: parts of growing size that do not overlap, zeros left out.
class ExactSum {
 public:
  void add(double x) {
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      const DoubleDouble sum = twoSum(x, part_[static_cast<std::size_t>(i)]);
      x = sum.hi;
      if (sum.lo != 0.0) part_[static_cast<std::size_t>(kept++)] = sum.lo;
    }
    if (x != 0.0) part_[static_cast<std::size_t>(kept++)] = x;
    count_ = kept;
  }
  /// That of the largest part: all others together are smaller.
  int sign() const {
    if (count_ == 0) return 0;
    return part_[static_cast<std::size_t>(count_) - 1] > 0.0 ? 1 : -1;
  }

 private:
  std::array<double, 200> part_;  // six products of three differences have 6 · 8 · 4 parts
  int count_ = 0;
};

/// Adds ± x y z, each a difference without error.
void addProduct(ExactSum& sum, double side, const DoubleDouble& x, const DoubleDouble& y,
                const DoubleDouble& z) {
  for (const double u : {x.hi, x.lo})
    for (const double v : {y.hi, y.lo}) {
      const DoubleDouble uv = twoProduct(side * u, v);
      for (const double w : {z.hi, z.lo})
        for (const double part : {uv.hi, uv.lo}) {
          const DoubleDouble product = twoProduct(part, w);
          sum.add(product.lo);
          sum.add(product.hi);
        }
    }
}

int exactOrientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  std::array<DoubleDouble, 3> u, v, w;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    u[i] = twoSum(b[k], -a[k]);
    v[i] = twoSum(c[k], -a[k]);
    w[i] = twoSum(d[k], -a[k]);
  }
  ExactSum sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    addProduct(sum, 1.0, u[i], v[j], w[k]);
    addProduct(sum, -1.0, u[j], v[i], w[k]);
  }
  return sum.sign();
}

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  constexpr double kHalfUnit = 1.1102230246251565e-16;  // 2⁻⁵³
  const Vec3 u = b - a, v = c - a, w = d - a;
  double det = 0.0, largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double forth = u[i] * v[j], back = u[j] * v[i];
    det += (forth - back) * w[k];
    largest += (std::abs(forth) + std::abs(back)) * std::abs(w[k]);
  }
  // Shewchuk's bound is (7 + 56 2⁻⁵³) 2⁻⁵³; ours leaves room for another order of the sum.
  if (std::abs(det) > 10.0 * kHalfUnit * largest) return det > 0.0 ? 1 : -1;
  return exactOrientation(a, b, c, d);
}

Vec3 twiceArea(const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kNarrow = 1e-4;  // sine of the angle at a: less, and digits are lost
  const Vec3 u = b - a, v = c - a, n = u.cross(v);
  if (n.squaredNorm() > kNarrow * kNarrow * u.squaredNorm() * v.squaredNorm()) return n;
  Vec3 careful;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    careful[i] =
        (twoSum(b[j], -a[j]) * twoSum(c[k], -a[k]) - twoSum(b[k], -a[k]) * twoSum(c[j], -a[j])).hi;
  }
  return careful;
}

bool pierces(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int above = orientation(a, b, c, p);
  if (above == 0 || orientation(a, b, c, q) != -above) return false;
  const int side = orientation(p, q, a, b);
  return side != 0 && side == orientation(p, q, b, c) && side == orientation(p, q, c, a);
}

}  // namespace tumble
