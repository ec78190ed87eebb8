// Whether convex parts share a volume.
#include "sim/collide/overlap.h"

#include "sim/math/rotation.h"
#include "sim/shape/convex_hull.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

Part box(const Vec3& edges, const Vec3& at, const Quat& q = Quat::Identity()) {
  return {Box{0.5 * edges}, {at, q}};
}

}  // namespace

// Oracle: gaps by hand, to both sides of touching: 1e-7 of overlap is seen, touching is not.
TEST_CASE("parts that touch do not overlap, parts that share a sliver do") {
  const Part cube = box({1, 1, 1}, {0, 0, 0});
  const Quat eighth = fromAxisAngle(Vec3::UnitZ(), 0.7853981633974483);
  const double diagonal = 0.5 + 0.7071067811865476;
  const struct {
    Part part;
    Vec3 away;
  } touching[] = {
      {box({1, 1, 1}, {1, 0, 0}), {1, 0, 0}},                                // face on face
      {box({1.5, 0.1, 0.1}, {1.25, 0.3, 0}), {1, 0, 0}},                     // a bar on a face
      {box({1, 1, 1}, {1, 1, 0.3}), {1, 0, 0}},                              // edge on edge, askew
      {box({1, 1, 1}, {diagonal, 0, 0}, eighth), {1, 0, 0}},                 // edge on face
      {{Sphere{0.25}, {{0, 0.75, 0}, Quat::Identity()}}, {0, 1, 0}},         // ball on face
      {{Cylinder{0.2, 1.0}, {{0.1, 1.0, 0}, Quat::Identity()}}, {0, 1, 0}},  // standing on a face
      {{Cylinder{0.2, 1.0}, {{0, 0.7, 0}, fromAxisAngle(Vec3::UnitZ(), 1.5707963267948966)}},
       {0, 1, 0}},  // lying on a face
  };
  for (const auto& [part, away] : touching) {
    CHECK_FALSE(overlap(cube, part));
    CHECK_FALSE(overlap(part, cube));
    Part nearer = part;
    nearer.pose.x -= 1e-7 * away;
    const bool edgeOnly = part.pose.x == Vec3(1, 1, 0.3);
    CHECK(overlap(cube, nearer) != edgeOnly);
    Part farther = part;
    farther.pose.x += 1e-7 * away;
    CHECK_FALSE(overlap(cube, farther));
  }
  CHECK(overlap(cube, cube));
  CHECK(overlap(cube, box({0.1, 0.1, 0.1}, {0.2, 0.1, 0})));  // one inside the other
}

// Oracle: gaps by hand. The hull is a unit cube with its points far from its own origin.
TEST_CASE("capsules and hulls touch and overlap where their surfaces are") {
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k) corners.emplace_back(100.0 + (k & 1), k >> 1 & 1, k >> 2);
  const auto solid = std::make_shared<const Polyhedron>(convexHull(corners));
  const auto hull = [&](const Vec3& at) {
    return Part{Hull{solid, -corners[0]}, {at - Vec3(100, 0, 0), Quat::Identity()}};
  };
  const Part cube = hull({0, 0, 0});
  const Quat lying = fromAxisAngle(Vec3::UnitZ(), 1.5707963267948966);
  const Vec3 diagonal = Vec3(1, 1, 1).normalized();
  const struct {
    Part part;
    Vec3 away;
  } touching[] = {
      {hull({1, 0, 0}), {1, 0, 0}},
      {hull({0.3, 0.4, -1}), {0, 0, -1}},
      {box({1, 1, 1}, {0.5, 1.5, 0.2}), {0, 1, 0}},
      {{Capsule{0.2, 1.0}, {{0.5, 1.7, 0.5}, Quat::Identity()}}, {0, 1, 0}},  // on its cap
      {{Capsule{0.2, 1.0}, {{0.5, 1.2, 0.5}, lying}}, {0, 1, 0}},             // on its side
      {{Capsule{0.2, 1.0}, {Vec3(1, 1.5, 1) + 0.2 * diagonal, Quat::Identity()}}, diagonal},
  };
  for (const auto& [part, away] : touching) {
    CHECK_FALSE(overlap(cube, part));
    CHECK_FALSE(overlap(part, cube));
    Part nearer = part;
    nearer.pose.x -= 1e-6 * away;
    CHECK(overlap(cube, nearer));
    CHECK(overlap(nearer, cube));
  }
  CHECK(overlap(cube, cube));
}

TEST_CASE("the parts of a compound that overlap are named") {
  const Part left = box({1, 1, 1}, {0, 0, 0}), right = box({1, 1, 1}, {1, 0, 0});
  CHECK(overlappingParts({{left, right}, Vec3::Zero()}) == std::pair(-1, -1));
  const Part between = box({0.5, 0.5, 0.5}, {0.5, 0, 0});
  CHECK(overlappingParts({{left, right, between}, Vec3::Zero()}) == std::pair(0, 2));
}
