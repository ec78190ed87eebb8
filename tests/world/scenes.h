// Small worlds that several tests look at.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "sim/math/rotation.h"
#include "sim/world.h"

namespace tumble::scenes {

inline BodyDef ground(double restitution = 0.0, double friction = 0.0) {
  BodyDef def;
  def.name = "ground";
  def.shape = HalfSpace{};
  def.fixed = true;
  def.restitution = restitution;
  def.friction = friction;
  return def;
}

inline BodyDef ball(const std::string& name, double r, const Vec3& x, double e = 0.0,
                    double mu = 0.0) {
  BodyDef def;
  def.name = name;
  def.shape = Sphere{r};
  def.mass = 1.0;
  def.position = x;
  def.restitution = e;
  def.friction = mu;
  return def;
}

inline BodyDef box(const std::string& name, const Vec3& edges, const Vec3& x, double e = 0.0,
                   double mu = 0.0) {
  BodyDef def;
  def.name = name;
  def.shape = Box{0.5 * edges};
  def.density = 1000.0;
  def.position = x;
  def.restitution = e;
  def.friction = mu;
  return def;
}

/// Bodies under gravity in the care of a method.
inline WorldDef worldOf(const char* method, double duration, std::vector<BodyDef> bodies) {
  WorldDef def;
  def.method = method;
  def.duration = duration;
  def.bodies = std::move(bodies);
  return def;
}

/// A plank at 60 degrees, its lower corner on the floor, its upper against a smooth wall.
/// @param side  of the least friction that holds it
inline WorldDef leaningPlank(const char* method, double side) {
  BodyDef plank = box("plank", {3.0, 0.1, 0.5}, Vec3::Zero());
  plank.orientation = fromAxisAngle({0.0, 0.0, 1.0}, 60.0 * std::numbers::pi / 180.0);
  const Vec3 B = plank.orientation * Vec3(-1.5, -0.05, 0.0);
  const Vec3 U = plank.orientation * Vec3(1.5, -0.05, 0.0);
  const double mu = -B.x() / (U.y() - B.y()) * side;
  plank.position = {-U.x(), -B.y(), 0.0};
  plank.friction = mu;
  BodyDef wall = ground();
  wall.name = "wall";
  wall.shape = HalfSpace{{-1.0, 0.0, 0.0}, 0.0};
  return worldOf(method, 10.0, {ground(0.0, mu), wall, plank});
}

/// Runs to the end in samples of 1/60 s and returns the last one.
inline Sample run(World& world) {
  const double duration = world.model().def.duration;
  for (int k = 0; k / 60.0 < duration; ++k) world.advance(k / 60.0);
  world.advance(duration);
  return world.sample(duration);
}

}  // namespace tumble::scenes
