#include "app/report/nudge.h"

#include <cmath>
#include <limits>

namespace tumble {

namespace {

// One unit in the last place of the vector's size up, down or none, number by number.
void nudge(Vec3& v, Random& random) {
  const double unit = v.norm() * std::numeric_limits<double>::epsilon();
  for (int i = 0; i < 3; ++i) {
    const double draw = std::floor(random.between(-1.0, 2.0));
    v[i] += draw * unit;
  }
}

void nudge(BodyDef& body, Random& random) {
  if (std::holds_alternative<HalfSpace>(body.shape)) return;
  nudge(body.position, random);
  nudge(body.velocity, random);
  nudge(body.angularVelocity, random);
  if (std::holds_alternative<Particle>(body.shape)) return;
  Vec3 turn = Vec3::Ones();
  nudge(turn, random);
  const Quat& q = body.orientation;
  const Vec3 small = 0.5 * (turn - Vec3::Ones());
  body.orientation = (Quat(1.0, small.x(), small.y(), small.z()) * q).normalized();
}

}  // namespace

void nudge(WorldDef& world, Random& random) {
  for (BodyDef& body : world.bodies) nudge(body, random);
}

}  // namespace tumble
