// Ls of two boxes that fall onto each other in columns, and boxes in their place.
#pragma once

#include <cstdint>
#include <string>

#include "sim/world.h"
#include "tests/collide/random_pose.h"

namespace tumble {

/// An L, 30 cm wide and high.
inline Compound ellOfBoxes() {
  return {{{Box{{0.15, 0.05, 0.05}}, {{0.15, 0.05, 0.0}}},
           {Box{{0.05, 0.1, 0.05}}, {{0.05, 0.2, 0.0}}}}};
}

/// A box of the same width, depth and mass.
inline Box boxLikeEll() {
  return {{0.15, 0.25 / 3.0, 0.05}};
}

/// So many bodies of a shape that fall in columns² columns, each turned at random.
inline WorldDef fallingInColumns(const Shape& shape, int count, int columns, std::uint64_t seed) {
  Random random(seed);
  WorldDef def;
  def.method = "stepping";
  def.duration = 1.5;
  BodyDef ground;
  ground.name = "ground";
  ground.shape = HalfSpace{};
  ground.fixed = true;
  ground.friction = 0.4;
  def.bodies.push_back(ground);
  for (int k = 0; k < count; ++k) {
    BodyDef body;
    body.name = "body." + std::to_string(k);
    body.shape = shape;
    body.shape = centredShape(body);
    body.density = 500.0;
    body.friction = 0.4;
    const int column = k % (columns * columns);
    const double x = random.uniform(-0.01, 0.01), z = random.uniform(-0.01, 0.01);
    body.position = {0.48 * (column % columns) + x, 0.4 + 0.5 * (k / (columns * columns)),
                     0.48 * (column / columns) + z};
    body.orientation = random.rotation();
    def.bodies.push_back(body);
  }
  return def;
}

}  // namespace tumble
