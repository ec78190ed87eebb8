#include "sim/joint/joint.h"

namespace tumble {
namespace {

/// The two joined points, and what moves them apart besides accelerations.
struct Ends {
  Vec3 pa, pb;       // [m]
  Vec3 rate;         // [m/s] ṗa − ṗb
  Vec3 centripetal;  // [m/s²]
};

template <class Joint>
Ends endsOf(std::span<const RigidBody> bodies, const Joint& joint) {
  const RigidBody &a = bodies[joint.a], &b = bodies[joint.b];
  Ends ends;
  ends.pa = toWorld(a.pose(), joint.anchorA_B);
  ends.pb = toWorld(b.pose(), joint.anchorB_B);
  ends.rate = pointVelocity(a, ends.pa) - pointVelocity(b, ends.pb);
  ends.centripetal =
      a.omega.cross(a.omega.cross(ends.pa - a.x)) - b.omega.cross(b.omega.cross(ends.pb - b.x));
  return ends;
}

void addEquality(std::span<const RigidBody> bodies, int a, int b, const Ends& ends, const Vec3& d,
                 double bias, Problem& problem) {
  problem.cones.push_back(
      {.kind = ConeKind::Equality, .row = static_cast<int>(problem.rows.size()), .mu = 0.0});
  problem.rows.push_back({.a = a,
                          .b = b,
                          .linear = d,
                          .angularA = (ends.pa - bodies[a].x).cross(d),
                          .angularB = -(ends.pb - bodies[b].x).cross(d),
                          .bias = bias});
}

}  // namespace

double gap(std::span<const RigidBody> bodies, const BallJoint& joint) {
  const Ends ends = endsOf(bodies, joint);
  return (ends.pa - ends.pb).norm();
}

double gap(std::span<const RigidBody> bodies, const DistanceJoint& joint) {
  const Ends ends = endsOf(bodies, joint);
  return (ends.pa - ends.pb).norm() - joint.length;
}

void addRows(std::span<const RigidBody> bodies, const BallJoint& joint, Problem& problem) {
  const Ends ends = endsOf(bodies, joint);
  for (int axis = 0; axis < 3; ++axis)
    addEquality(bodies, joint.a, joint.b, ends, Vec3::Unit(axis), ends.centripetal[axis], problem);
}

void addRows(std::span<const RigidBody> bodies, const DistanceJoint& joint, Problem& problem) {
  const Ends ends = endsOf(bodies, joint);
  const Vec3 offset = ends.pa - ends.pb, d = offset.normalized();
  const Vec3 across = ends.rate - ends.rate.dot(d) * d;
  const double bias = d.dot(ends.centripetal) + across.squaredNorm() / offset.norm();
  addEquality(bodies, joint.a, joint.b, ends, d, bias, problem);
}

}  // namespace tumble
