// Small worlds that several tests look at.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "sim/math/rotation.h"
#include "sim/world.h"
#include "tests/world/draws.h"

namespace tumble::scenes {

inline constexpr double kPi = std::numbers::pi;

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

/// A round table, of radius 5 m with its top at y = 0, that turns about the vertical.
inline BodyDef turntable(double speed, double mu) {
  BodyDef table;
  table.name = "table";
  table.shape = Cylinder{5.0, 0.2};
  table.position = {0.0, -0.1, 0.0};
  table.fixed = true;
  table.friction = mu;
  table.angularVelocity = {0.0, speed, 0.0};
  return table;
}

/// A ball that rolls on it with this velocity.
inline BodyDef ballOnTurntable(double speed, const Vec3& x, const Vec3& velocity) {
  const Vec3 up = Vec3::UnitY();
  BodyDef rolling = ball("ball", x.y(), x, 0.0, 1.0);
  rolling.velocity = velocity;
  rolling.angularVelocity = up.cross(velocity - speed * up.cross(x)) / x.y();
  return rolling;
}

/// Bodies under gravity in the care of a method.
inline WorldDef worldOf(const char* method, double duration, std::vector<BodyDef> bodies) {
  WorldDef def;
  def.method = method;
  def.duration = duration;
  def.bodies = std::move(bodies);
  return def;
}

/// A world without bodies for the exact method.
inline WorldDef exactWorld(double duration) {
  return worldOf("exact", duration, {});
}

/// Cubes one above the other, the first of them here; their names end in their numbers.
inline void addColumn(WorldDef& def, int n, double edge, const Vec3& first, double e, double mu) {
  for (int i = 0; i < n; ++i)
    def.bodies.push_back(box("box" + std::to_string(i), {edge, edge, edge},
                             {first.x(), first.y() + edge * i, first.z()}, e, mu));
}

/// Half-metre cubes of 1 kg in so many columns along x and z and layers, at rest, or on a smooth
/// floor, along which they drift or are pulled [m/s²]. Columns stand apart; bonded, every other
/// layer is shifted, and cubes stand on two.
inline WorldDef stackOf(int wide, int high, int deep, bool bonded, double speed,
                        double pull = 0.0) {
  const bool moves = speed > 0.0 || pull > 0.0;
  WorldDef def = worldOf("stepping", 1e6, {ground(0.0, moves ? 0.0 : 0.5)});
  def.gravity.x() = pull;
  for (int y = 0; y < high; ++y)
    for (int x = 0; x < wide; ++x)
      for (int z = 0; z < deep; ++z) {
        const double aside = bonded && y % 2 ? 0.24 : 0.0;
        def.bodies.push_back(box("box." + std::to_string(def.bodies.size()), {0.5, 0.5, 0.5},
                                 {0.5 * x + aside + 0.01 * x, 0.25 + 0.5 * y, 0.6 * z}, 0.0, 0.5));
        def.bodies.back().density.reset();
        def.bodies.back().mass = 1.0;
        def.bodies.back().velocity = {speed, 0.0, 0.0};
      }
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

/// Bricks of any shape and spin above a smooth floor that gives all back.
inline WorldDef thrownBrick(unsigned seed) {
  Draws draw{std::mt19937(seed)};
  WorldDef def = worldOf("stepping", 5.0, {ground(1.0)});
  const double width = draw(0.1, 0.5), height = draw(0.1, 0.5), depth = draw(0.1, 0.5);
  BodyDef brick = box("brick", {width, height, depth}, {0.0, 1.0, 0.0}, 1.0);
  const double x = draw(-1, 1), y = draw(-1, 1), z = draw(-1, 1);
  brick.orientation = Quat(1.0, x, y, z).normalized();
  const double wx = draw(-5, 5), wy = draw(-5, 5), wz = draw(-5, 5);
  brick.angularVelocity = {wx, wy, wz};
  def.bodies.push_back(brick);
  return def;
}

}  // namespace tumble::scenes
