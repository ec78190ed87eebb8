// Chapter 5, collide: what every contact point of every pair promises.
#include <algorithm>

#include "sim/collide/collide.h"
#include "tests/catch.h"
#include "tests/collide/random_pose.h"

namespace tumble {
namespace {

// Balls, boxes and half-spaces within reach of each other.
Shape someBallBoxOrPlane(Random& random, int kind) {
  if (kind == 0) return Sphere{random.uniform(0.1, 1.0)};
  if (kind == 1) return random.box();
  const Vec3 n = random.direction();
  return HalfSpace{n, random.uniform(-0.5, 0.5)};
}

struct ShapePair {
  Shape a, b;
  Pose poseA, poseB;
};

ShapePair someShapePair(Random& random) {
  for (;;) {
    const int kindA = random.below(3);
    const int kindB = random.below(3);
    const Shape a = someBallBoxOrPlane(random, kindA);
    const Shape b = someBallBoxOrPlane(random, kindB);
    if (!canCollide(a, b)) continue;
    const Pose poseA = random.pose(1.0);
    const Pose poseB = random.pose(1.0);
    return {a, b, poseA, poseB};
  }
}

// n·(p_a − p_b) > 0 for points inside the bodies: the direction in which parting takes place.
bool partsAlong(const ShapePair& pair, const Vec3& n, double step) {
  ShapePair apart = pair;
  if (std::holds_alternative<HalfSpace>(pair.a)) {
    apart.poseB.x -= step * n;
  } else {
    apart.poseA.x += step * n;
  }
  return separation(apart.a, apart.poseA, apart.b, apart.poseB) >
         separation(pair.a, pair.poseA, pair.b, pair.poseB);
}

// Oracle: the definition. Only rounding of coordinates near 1 remains: measured 2.0e-15,
// allowed 1e-14.
TEST_CASE("pa - pb = (separation + ra + rb) n, and p is midway between the surfaces") {
  Random random(1);
  Manifold manifold;
  double worst = 0.0;
  int points = 0;
  for (int k = 0; k < 20000; ++k) {
    const ShapePair pair = someShapePair(random);
    collide(pair.a, pair.poseA, pair.b, pair.poseB, 0.05, manifold);
    for (const ContactPoint& c : manifold) {
      ++points;
      const Vec3 surfaceA = c.pa - c.ra * c.n, surfaceB = c.pb + c.rb * c.n;
      worst = std::max(worst, (c.pa - c.pb - (c.separation + c.ra + c.rb) * c.n).norm());
      worst = std::max(worst, (c.p - 0.5 * (surfaceA + surfaceB)).norm());
      worst = std::max(worst, std::abs(c.n.norm() - 1.0));
      REQUIRE((c.n - manifold[0].n).norm() == 0.0);
      REQUIRE(c.separation <= 0.05);
    }
    if (!manifold.empty()) REQUIRE(partsAlong(pair, manifold[0].n, 1e-4));
  }
  CAPTURE(worst, points);
  REQUIRE(points > 20000);
  REQUIRE(worst < 1e-14);
}

}  // namespace
}  // namespace tumble
