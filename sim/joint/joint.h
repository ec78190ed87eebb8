// Chapter 8, joint: what holds two bodies together, as equality rows of the one problem (slide
// SD57).
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/body/force.h"
#include "sim/body/rigid_body.h"

namespace tumble {

/// What a joint leaves free of the six motions of a against b.
enum class JointKind {
  Ball,      ///< one point of each coincides: three turns are free
  Hinge,     ///< and they share an axis: one turn is free, between limits
  Slider,    ///< a moves along an axis of b and does not turn, between limits
  Distance,  ///< a rod between one point of each, or, with limits, a rope: max alone
  Fixed,     ///< nothing
};

/// A row of the table of joints.
struct JointName {
  JointKind kind;
  std::string_view name;  ///< value of `kind` in a scene
  bool axis, limits;      ///< whether it has an axis, and limits
};
std::span<const JointName> jointNames();
/// The row of a kind.
const JointName& jointName(JointKind kind);

/// A joint as its author describes it, at the start. World frame, SI.
struct JointDef {
  std::string name = {};
  JointKind kind = JointKind::Ball;
  int a = 0, b = kNoBody;       ///< bodies; kNoBody is the world
  Vec3 anchorA = Vec3::Zero();  ///< [m] on a
  Vec3 anchorB = Vec3::Zero();  ///< [m] on b; the same point unless it is a distance
  Vec3 axis = Vec3::UnitZ();    ///< of a hinge, a slider
  /// Turn of a against b about the axis [rad], way of a along it [m], both 0 at the start; or the
  /// distance [m], which without limits stays what it is.
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool collide = false;  ///< whether the two bodies may touch
};

/// The same, ready to run.
struct Joint {
  JointKind kind = JointKind::Ball;
  int a = 0, b = 0;  ///< b = the number of bodies: the world, which never moves
  Vec3 anchorA_B = Vec3::Zero(), anchorB_B = Vec3::Zero();        ///< [m]
  Mat3 frameA_B = Mat3::Identity(), frameB_B = Mat3::Identity();  ///< axis and two across; as one
  double lo = 0.0, hi = 0.0;                                      ///< as in the definition
  double length = 0.0;                                            ///< [m] of a rod
  double arm = 1.0;  ///< [m] farthest point of its bodies from the anchor: what a turn moves
};

/// @param bodies  at the start
/// @param arm     [m] > 0
Joint makeJoint(const JointDef& def, std::span<const RigidBody> bodies, double arm);

/// What b of a joint is: a body, or the world.
const RigidBody& partner(std::span<const RigidBody> bodies, int b);

/// What a joint exerts at one moment. World frame.
struct JointForce {
  int joint = 0;
  int a = 0, b = 0;            ///< bodies; b = their number: the world
  Vec3 p = Vec3::Zero();       ///< [m] the anchor, on a
  Vec3 force = Vec3::Zero();   ///< [N] on a
  Vec3 torque = Vec3::Zero();  ///< [N m] on a, about p
};

}  // namespace tumble
