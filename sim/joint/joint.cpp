#include "sim/joint/joint.h"

#include "sim/body/mass_properties.h"

namespace tumble {
namespace {

constexpr JointName kNames[] = {
    {JointKind::Ball, "ball", false, false},   {JointKind::Hinge, "hinge", true, true},
    {JointKind::Slider, "slider", true, true}, {JointKind::Distance, "distance", false, true},
    {JointKind::Fixed, "fixed", false, false},
};

/// The axis and two unit vectors across it, right-handed.
Mat3 frameAlong(const Vec3& axis) {
  Mat3 frame;
  frame.col(0) = axis.stableNormalized();
  frame.col(1) = frame.col(0).unitOrthogonal();
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

}  // namespace

std::span<const JointName> jointNames() {
  return kNames;
}

const JointName& jointName(JointKind kind) {
  return kNames[static_cast<int>(kind)];
}

const RigidBody& partner(std::span<const RigidBody> bodies, int b) {
  static const RigidBody world = makeFixedBody({});
  return b < static_cast<int>(bodies.size()) ? bodies[b] : world;
}

Joint makeJoint(const JointDef& def, std::span<const RigidBody> bodies, double arm) {
  const int world = static_cast<int>(bodies.size());
  Joint joint{.kind = def.kind, .a = def.a, .b = def.b < 0 ? world : def.b};
  const RigidBody &a = bodies[joint.a], &b = partner(bodies, joint.b);
  joint.anchorA_B = a.R.transpose() * (def.anchorA - a.x);
  joint.anchorB_B = b.R.transpose() * (def.anchorB - b.x);
  const Mat3 frame = frameAlong(def.axis);
  joint.frameA_B = a.R.transpose() * frame;
  joint.frameB_B = b.R.transpose() * frame;
  joint.lo = def.lo;
  joint.hi = def.hi;
  joint.length = (def.anchorA - def.anchorB).norm();
  joint.arm = arm;
  return joint;
}

}  // namespace tumble
