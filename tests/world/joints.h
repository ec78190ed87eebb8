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

/// A car on four wheels that rolls along x on a floor, and turns about the vertical besides [m/s,
/// rad/s]. Its wheels lie on lines, so that what pushes them sideways is not determined.
inline WorldDef carOf(double speed, double yaw) {
  constexpr double kRadius = 0.12, kDensity = 500.0;
  WorldDef def = worldOf("stepping", 0.4, {ground(0.2, 0.6)});
  const auto add = [&](const char* name, const Shape& shape, const Vec3& at, double spin) {
    BodyDef body{.name = name, .shape = shape, .density = kDensity, .restitution = 0.2};
    body.friction = 0.6;
    body.position = at;
    body.velocity = Vec3(speed, 0.0, 0.0) + Vec3(0.0, yaw, 0.0).cross(at);
    body.angularVelocity = {0.0, yaw, spin};
    def.bodies.push_back(body);
  };
  add("chassis", Box{{0.4, 0.075, 0.2}}, {0.0, kRadius + 0.1, 0.0}, 0.0);
  for (const double x : {0.3, -0.3})
    for (const double z : {0.28, -0.28}) {
      const Vec3 at(x, kRadius, z);
      const int wheel = static_cast<int>(def.bodies.size());
      add("wheel", Cylinder{kRadius, 0.03}, at, -speed / kRadius);
      def.bodies.back().name += std::to_string(wheel);
      def.bodies.back().orientation = Quat(Eigen::AngleAxisd(0.5 * kPi, Vec3::UnitX()));
      def.joints.push_back(hinge(wheel, 1, at, "axle" + std::to_string(wheel)));
    }
  return def;
}

}  // namespace tumble::scenes
