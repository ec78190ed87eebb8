#include "sim/body/samples.h"

#include <algorithm>
#include <cmath>

#include "sim/shape/interior.h"

namespace tumble {
namespace {

/// Draw k of a seed, uniform in [0, 1): SplitMix64 (Steele, Lea, Flood 2014), any draw on its own.
double draw(std::uint64_t seed, std::uint64_t k) {
  std::uint64_t z = seed * 0xD1342543DE82EF95u + (k + 1) * 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-53;
}

/// The digits of i in a base, mirrored at the point: 6 = 110₂ becomes 0.011₂.
double radicalInverse(std::uint64_t i, std::uint64_t base) {
  std::uint64_t mirrored = 0, scale = 1;
  for (; i > 0; i /= base, scale *= base) mirrored = mirrored * base + i % base;
  return static_cast<double>(mirrored) / static_cast<double>(scale);
}

/// Edge [m] of a cube of which `count` fill a box.
double edgeFor(const Vec3& size, int count) {
  // The root by bisection: it need not be exact, and std::cbrt differs between libraries.
  const double volume = size.prod() / count;
  double lo = 0.0, hi = size.maxCoeff();
  for (int k = 0; k < 60; ++k) {
    const double edge = 0.5 * (lo + hi);
    (edge * edge * edge < volume ? lo : hi) = edge;
  }
  return 0.5 * (lo + hi);
}

}  // namespace

Samples::Samples(Spread spread, const Aabb& box, int count, std::uint64_t seed)
    : spread_(spread), box_(box), count_(count), seed_(seed) {
  if (spread != Spread::Grid) return;
  const Vec3 size = box.hi - box.lo;
  const double edge = edgeFor(size, count);
  count_ = 1;
  for (int axis = 0; axis < 3; ++axis) {
    cells_[axis] = std::max(1, static_cast<int>(size[axis] / edge + 0.5));
    count_ *= cells_[axis];
  }
}

Vec3 Samples::operator[](int i) const {
  const std::uint64_t k = static_cast<std::uint64_t>(i);
  Vec3 u;
  if (spread_ == Spread::Grid) {
    const int cell[3] = {i % cells_[0], i / cells_[0] % cells_[1], i / cells_[0] / cells_[1]};
    for (int axis = 0; axis < 3; ++axis) u[axis] = (cell[axis] + 0.5) / cells_[axis];
  } else if (spread_ == Spread::Random) {
    for (std::uint64_t axis = 0; axis < 3; ++axis) u[axis] = draw(seed_, 3 * k + axis);
  } else {
    u = Vec3(radicalInverse(k + 1, 2), radicalInverse(k + 1, 3), radicalInverse(k + 1, 5));
  }
  return box_.lo + u.cwiseProduct(box_.hi - box_.lo);
}

std::vector<Vec3> pointsInside(const Shape& shape, Spread spread, int count, std::uint64_t seed) {
  const Interior interior(shape);
  const Samples samples(spread, boxAsGiven(shape), count, seed);
  const Vec3 origin = originOf(shape);
  std::vector<Vec3> points;
  for (int i = 0; i < samples.count(); ++i) {
    const Vec3 p = samples[i];
    if (interior.contains(p)) points.push_back(p - origin);
  }
  return points;
}

}  // namespace tumble
