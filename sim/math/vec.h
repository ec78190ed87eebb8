// Chapter 0, math: the vectors that every other chapter speaks in.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tumble {

using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Mat3 = Eigen::Matrix3d;
using VecX = Eigen::VectorXd;
using MatX = Eigen::MatrixXd;
using Quat = Eigen::Quaterniond;

/// Where a body frame stands in the world: p = R(q) p_B + x.
struct Pose {
  Vec3 x = Vec3::Zero();      ///< [m] origin of the body frame, world
  Quat q = Quat::Identity();  ///< [1] unit, takes body to world
};

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
