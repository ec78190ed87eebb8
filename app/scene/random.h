// Random numbers that are the same on every machine and with every compiler.
#pragma once

#include <cstdint>
#include <string_view>

#include "sim/math/vec.h"

namespace tumble {

/// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014): a
/// counter of odd stride, mixed. Period 2⁶⁴. One draw per call; a caller makes one call per
/// statement.
class Random {
 public:
  /// @param stream  a name; each has numbers of its own for the same seed
  Random(std::uint64_t seed, std::string_view stream);

  std::uint64_t bits();
  /// Uniform in [0, 1): the upper 53 bits, times 2⁻⁵³.
  double unit();
  /// Uniform in [lo, hi).
  double between(double lo, double hi);
  /// Uniform in the box.
  Vec3 inBox(const Vec3& lo, const Vec3& hi);
  /// Uniform over all orientations: a point of the unit ball in four dimensions, by rejection, put
  /// on its sphere.
  Quat orientation();

 private:
  std::uint64_t state_;
};

}  // namespace tumble
