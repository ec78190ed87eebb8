// Bodies at random, the same at every call.
#pragma once

#include <cmath>
#include <random>

#include "tests/body/bodies.h"

namespace tumble::test {

struct Draw {
  std::mt19937_64 engine;
  double operator()(double from, double to) {
    return from + (to - from) * static_cast<double>(engine() >> 11) * 0x1p-53;
  }
  Vec3 vector(double size) {
    const double x = (*this)(-size, size), y = (*this)(-size, size), z = (*this)(-size, size);
    return {x, y, z};
  }
};

/// A body whose extents are spread evenly over three decades, so that its moments differ by up to
/// 1e6; turned and spinning anyhow at up to 100 rad/s.
inline RigidBody randomBody(Draw& draw) {
  Vec3 squares;  // ∫ x² dm along each axis
  for (int i = 0; i < 3; ++i) squares[i] = std::pow(10.0, draw(-6.0, 0.0));
  const Vec3 moments(squares[1] + squares[2], squares[2] + squares[0], squares[0] + squares[1]);
  const Vec3 axis = draw.vector(1.0), omega = draw.vector(1.0).normalized();
  const double angle = draw(0.0, 6.0), speed = draw(0.0, 100.0);
  return spinning(moments, fromAxisAngle(axis, angle), speed * omega);
}

}  // namespace tumble::test
