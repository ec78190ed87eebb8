// Chapter 0, math: points and poses, from one frame into another.
#pragma once

#include "sim/math/vec.h"

namespace tumble {

/// World point [m] of the body point `p_B` [m].
inline Vec3 toWorld(const Pose& pose, const Vec3& p_B) {
  return pose.q * p_B + pose.x;
}

/// Where in the world a frame stands whose pose in the body frame is `pose_B`.
inline Pose toWorld(const Pose& pose, const Pose& pose_B) {
  return {toWorld(pose, pose_B.x), pose.q * pose_B.q};
}

/// Body point [m] of the world point `p` [m].
inline Vec3 toBody(const Pose& pose, const Vec3& p) {
  return pose.q.conjugate() * (p - pose.x);
}

}  // namespace tumble
