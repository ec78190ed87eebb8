// Joints for worlds, and what hangs on them.
#pragma once

#include <cmath>
#include <string>

#include "tests/world/scenes.h"

namespace tumble::scenes {

constexpr double kG = 9.81;  // m/s²

/// A hinge about z at a point of the world.
inline JointDef hinge(int a, int b, const Vec3& anchor, const std::string& name = "hinge") {
  return {
      .name = name, .kind = JointKind::Hinge, .a = a, .b = b, .anchorA = anchor, .anchorB = anchor};
}

/// A bar of length l that hangs from `top` at an angle from the vertical, in the plane z = 0.
inline BodyDef bar(const std::string& name, double l, double m, const Vec3& top, double angle) {
  BodyDef def;
  def.name = name;
  def.shape = Box{{0.03, 0.5 * l, 0.05}};
  def.mass = m;
  def.orientation = rotated(Quat::Identity(), {0.0, 0.0, angle});
  def.position = top + 0.5 * l * Vec3(std::sin(angle), -std::cos(angle), 0.0);
  return def;
}

/// Angle from the vertical of a bar.
inline double angleOf(const BodySample& body) {
  const Vec3 down = body.q * Vec3(0.0, -1.0, 0.0);
  return std::atan2(down.x(), -down.y());
}

/// A world whose error in a step is 1e-13 where the method chooses its steps.
inline WorldDef careful(const std::string& method) {
  WorldDef def;
  def.method = method;
  def.course.integrator = "dopri5";
  def.course.tolerance = 1e-13;
  return def;
}

}  // namespace tumble::scenes
