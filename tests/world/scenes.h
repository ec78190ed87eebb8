// Small worlds that several tests look at.
#pragma once

#include <cmath>
#include <string>

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

/// Runs to the end in samples of 1/60 s and returns the last one.
inline Sample run(World& world) {
  const double duration = world.model().def.duration;
  for (int k = 0; k / 60.0 < duration; ++k) world.advance(k / 60.0);
  world.advance(duration);
  return world.sample(duration);
}

}  // namespace tumble::scenes
