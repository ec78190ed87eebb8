#include "tests/peers/overlap.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace tumble::peers {

namespace {

// Half the extent of a box along a unit axis.
double reach(const Box& box, const Mat3& R, const Vec3& axis) {
  return (R.transpose() * axis).cwiseAbs().dot(box.half);
}

double boxes(const Box& a, const Pose& poseA, const Box& b, const Pose& poseB) {
  constexpr double kParallel = 1e-6;  // sine below which edges give no axis of their own
  const Mat3 A = poseA.q.toRotationMatrix(), B = poseB.q.toRotationMatrix();
  const Vec3 way = poseA.x - poseB.x;
  double depth = std::numeric_limits<double>::infinity();
  const auto hold = [&](const Vec3& axis) {
    depth = std::min(depth, reach(a, A, axis) + reach(b, B, axis) - std::abs(way.dot(axis)));
  };
  for (int i = 0; i < 3; ++i) {
    hold(A.col(i));
    hold(B.col(i));
  }
  for (int i = 0; i < 3 && depth > 0.0; ++i)
    for (int k = 0; k < 3; ++k) {
      const Vec3 axis = A.col(i).cross(B.col(k));
      if (axis.norm() > kParallel) hold(axis.normalized());
    }
  return depth;
}

// The nearest point of the box; of a centre inside, the nearest face.
double ballInBox(const Sphere& ball, const Vec3& centre, const Box& box, const Pose& pose) {
  const Vec3 c = pose.q.conjugate() * (centre - pose.x);
  const Vec3 near = c.cwiseMax(-box.half).cwiseMin(box.half);
  const double gap = (c - near).norm();
  return gap > 0.0 ? ball.r - gap : ball.r + (box.half - c.cwiseAbs()).minCoeff();
}

double inPlane(const HalfSpace& plane, const Shape& shape, const Pose& pose) {
  const auto* ball = std::get_if<Sphere>(&shape);
  const double half =
      ball ? ball->r : reach(std::get<Box>(shape), pose.q.toRotationMatrix(), plane.n);
  return half - (plane.n.dot(pose.x) - plane.d);
}

}  // namespace

double overlap(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
  if (const auto* plane = std::get_if<HalfSpace>(&a)) return inPlane(*plane, b, poseB);
  if (const auto* plane = std::get_if<HalfSpace>(&b)) return inPlane(*plane, a, poseA);
  const auto *ballA = std::get_if<Sphere>(&a), *ballB = std::get_if<Sphere>(&b);
  if (ballA && ballB) return ballA->r + ballB->r - (poseA.x - poseB.x).norm();
  if (ballA) return ballInBox(*ballA, poseA.x, std::get<Box>(b), poseB);
  if (ballB) return ballInBox(*ballB, poseB.x, std::get<Box>(a), poseA);
  return boxes(std::get<Box>(a), poseA, std::get<Box>(b), poseB);
}

double deepestOverlap(const WorldDef& world, std::span<const BodySample> bodies) {
  const int count = static_cast<int>(world.bodies.size());
  const auto still = [&](int i) {
    return world.bodies[i].fixed || std::holds_alternative<HalfSpace>(world.bodies[i].shape);
  };
  std::vector<double> radius;
  for (const BodyDef& body : world.bodies) radius.push_back(boundingRadius(body.shape));
  double deepest = 0.0;
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < i; ++k) {
      if (still(i) && still(k)) continue;
      const double far = radius[i] + radius[k];
      if ((bodies[i].x - bodies[k].x).squaredNorm() > far * far) continue;
      deepest = std::max(deepest, overlap(world.bodies[i].shape, {bodies[i].x, bodies[i].q},
                                          world.bodies[k].shape, {bodies[k].x, bodies[k].q}));
    }
  return deepest;
}

}  // namespace tumble::peers
