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

}  // namespace tumble
