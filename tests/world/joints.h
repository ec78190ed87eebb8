// Joints for worlds, and what hangs on them.
#pragma once

#include <cmath>
#include <string>

#include "tests/gravity.h"
#include "tests/world/scenes.h"

namespace tumble::scenes {

using test::kG;

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

constexpr double kLink = 0.2;  // [m] from pin to pin

/// Balls on rods that hang from (0, 0, 0) straight out at this angle from the vertical.
inline WorldDef chainOf(const char* method, int links, double ratio, double angle) {
  WorldDef def = worldOf(method, 2.0, {});
  const Vec3 along(std::sin(angle), -std::cos(angle), 0.0);
  for (int k = 0; k < links; ++k) {
    BodyDef link = ball("link" + std::to_string(k), 0.05, (k + 1) * kLink * along);
    link.mass = k + 1 == links ? ratio : 1.0;
    def.bodies.push_back(link);
    def.joints.push_back({.name = "pin" + std::to_string(k),
                          .kind = JointKind::Ball,
                          .a = k,
                          .b = k == 0 ? kNoBody : k - 1,
                          .anchorA = k * kLink * along,
                          .anchorB = k * kLink * along});
  }
  return def;
}

/// A linkage of four bars, of which the world is one: its twenty rows repeat three.
inline void addFourBars(WorldDef& def) {
  const Vec3 feet[] = {{0.0, 0.0, 0.0}, {1.2, 0.0, 0.0}},
             pins[] = {{-0.3, -0.6, 0.0}, {1.0, -0.9, 0.0}};
  const auto between = [](const std::string& name, const Vec3& p, const Vec3& q) {
    return bar(name, (q - p).norm(), 1.0, p, std::atan2((q - p).x(), (p - q).y()));
  };
  def.bodies = {between("crank", feet[0], pins[0]), between("coupler", pins[0], pins[1]),
                between("rocker", feet[1], pins[1])};
  def.joints = {hinge(0, kNoBody, feet[0], "h.0"), hinge(1, 0, pins[0], "h.1"),
                hinge(2, kNoBody, feet[1], "h.2"), hinge(2, 1, pins[1], "h.3")};
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
