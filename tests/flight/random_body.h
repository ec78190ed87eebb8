// Bodies at random, the same at every call.
#pragma once

#include <cmath>

#include "tests/body/bodies.h"
#include "tests/collide/random_pose.h"

namespace tumble::test {

/// A body whose extents are spread evenly over three decades, so that its moments differ by up to
/// 1e6; turned and spinning anyhow at up to 100 rad/s.
inline RigidBody randomBody(Random& random) {
  Vec3 squares;  // ∫ x² dm along each axis
  for (int i = 0; i < 3; ++i) squares[i] = std::pow(10.0, random.uniform(-6.0, 0.0));
  const Vec3 moments(squares[1] + squares[2], squares[2] + squares[0], squares[0] + squares[1]);
  const Vec3 axis = random.vector(-1.0, 1.0), omega = random.vector(-1.0, 1.0).normalized();
  const double angle = random.uniform(0.0, 6.0), speed = random.uniform(0.0, 100.0);
  return spinning(moments, fromAxisAngle(axis, angle), speed * omega);
}

}  // namespace tumble::test
