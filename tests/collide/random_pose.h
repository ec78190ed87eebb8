// Random shapes and poses for the tests of collide: one draw a statement, the same on every
// compiler.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "sim/math/frames.h"
#include "sim/math/vec.h"
#include "sim/shape/shape.h"

namespace tumble {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double lo, double hi) {
    return lo + (hi - lo) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }
  Vec3 vector(double lo, double hi) {
    const double x = uniform(lo, hi);
    const double y = uniform(lo, hi);
    const double z = uniform(lo, hi);
    return {x, y, z};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = vector(-1.0, 1.0);
      const double length = v.norm();
      if (length > 0.1 && length < 1.0) return v / length;
    }
  }
  Quat rotation() {
    for (;;) {
      const double w = uniform(-1.0, 1.0);
      const Vec3 v = vector(-1.0, 1.0);
      const double length = std::sqrt(w * w + v.squaredNorm());
      if (length < 0.1 || length > 1.0) continue;
      return {w / length, v.x() / length, v.y() / length, v.z() / length};
    }
  }
  Pose pose(double reach) {
    const Vec3 x = vector(-reach, reach);
    return {x, rotation()};
  }
  Box box(double smallest = 0.1, double largest = 1.0) { return {vector(smallest, largest)}; }

 private:
  std::mt19937_64 engine_;
};

/// The pose a body gets when the world is moved by `motion`.
inline Pose moved(const Pose& motion, const Pose& pose) {
  return {toWorld(motion, pose.x), (motion.q * pose.q).normalized()};
}

inline Quat turn(const Vec3& axis, double degrees) {
  return Quat(Eigen::AngleAxisd(degrees * 3.14159265358979323846 / 180.0, axis.normalized()));
}

/// A turn by some eighths about an axis of the frame.
inline Quat someEighths(Random& random) {
  const int axis = random.below(3);
  const int eighths = random.below(8);
  return turn(Vec3::Unit(axis), 45.0 * eighths);
}

}  // namespace tumble
