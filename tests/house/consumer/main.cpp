// Drops a ball for half a second and compares with ½ g t².
#include <cmath>
#include <cstdio>

#include "sim/world.h"

int main() {
  tumble::WorldDef def;
  def.bodies = {{.name = "ball", .mass = 1.0, .position = {0.0, 2.0, 0.0}}};
  tumble::World world(def);
  world.advance(0.5);
  const double height = world.sample(0.5).bodies[0].x.y();
  std::printf("height %.17g m, closed form %.17g m\n", height, 2.0 - 0.5 * 9.81 * 0.25);
  return std::abs(height - (2.0 - 0.5 * 9.81 * 0.25)) < 1e-12 ? 0 : 1;
}
