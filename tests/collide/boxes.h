// Two posed boxes for the tests of box against box.
#pragma once

#include <cmath>

#include "sim/collide/collide.h"
#include "tests/collide/random_pose.h"

namespace tumble {

inline const Box kCube{Vec3::Constant(0.5)};
inline const double kHalfDiagonal = std::sqrt(0.5);  // of a face of the cube

struct Boxes {
  Box a, b;
  Pose poseA, poseB;
  double gap() const { return separation(a, poseA, b, poseB); }
  Manifold points(double margin) const {
    Manifold manifold;
    collide(a, poseA, b, poseB, margin, manifold);
    return manifold;
  }
  Boxes swapped() const { return {b, a, poseB, poseA}; }
  Boxes movedBy(const Pose& motion) const {
    return {a, b, moved(motion, poseA), moved(motion, poseB)};
  }
};

}  // namespace tumble
