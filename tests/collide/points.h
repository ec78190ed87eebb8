// The contact points of two solids where they stand.
#pragma once

#include "sim/collide/collide.h"

namespace tumble {

inline Manifold points(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB,
                       double margin) {
  Manifold manifold;
  collide(a, poseA, b, poseB, margin, manifold);
  return manifold;
}

}  // namespace tumble
