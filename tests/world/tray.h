// Bodies that fall into a tray, as other engines are given them (tests/peers/scenes).
#pragma once

#include <cmath>
#include <string>

#include "tests/world/draws.h"
#include "tests/world/scenes.h"

namespace tumble::scenes {

inline const Shape kBrick = Box{{0.15, 0.1, 0.1}};

/// So many bodies of a shape, turned at random, in layers above a floor between four walls.
inline WorldDef tray(const Shape& shape, int count) {
  constexpr double e = 0.2, mu = 0.5, apart = 0.5;
  Draws draws{std::mt19937(7)};
  const auto draw = [&] { return draws(-0.5, 0.5); };
  const int wide = static_cast<int>(std::lround(std::sqrt(count / 4.0))) - 1;
  const double half = 0.35 * (wide + 1);
  WorldDef def;
  def.method = "stepping";
  def.duration = 5.0;
  def.bodies.push_back(ground(e, mu));
  for (const Vec3& at :
       {Vec3(half, 1.0, 0.0), Vec3(-half, 1.0, 0.0), Vec3(0.0, 1.0, half), Vec3(0.0, 1.0, -half)}) {
    const Vec3 sides =
        at.x() == 0.0 ? Vec3(2.0 * half + 0.4, 2.0, 0.2) : Vec3(0.2, 2.0, 2.0 * half);
    BodyDef wall = box("wall." + std::to_string(def.bodies.size()), sides, at, e, mu);
    wall.fixed = true;
    def.bodies.push_back(wall);
  }
  for (int k = 0; k < count; ++k) {
    const int layer = k / (wide * wide), column = k / wide % wide, row = k % wide;
    BodyDef body = box("body." + std::to_string(k), Vec3::Zero(),
                       {apart * (row - 0.5 * (wide - 1)) + 0.06 * draw(), 0.5 + apart * layer,
                        apart * (column - 0.5 * (wide - 1)) + 0.06 * draw()},
                       e, mu);
    body.shape = shape;
    body.orientation = Quat(draw(), draw(), draw(), draw()).normalized();
    def.bodies.push_back(body);
  }
  return def;
}

}  // namespace tumble::scenes
