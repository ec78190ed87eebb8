// At the end everything lies still, and what never moves carries the weight of all the rest.
#include <algorithm>
#include <cmath>

#include "app/claim/free_body.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

// Allowed: of the weight, [m/s], [m]. Measured 7e-12, 1e-12, 2e-11.
constexpr double kWeight = 1e-9, kSpeed = 1e-6, kOverlap = 1e-9;

// Of what moves, by what does not [N].
Vec3 groundForce(const Scene& scene, const Sample& sample) {
  Vec3 sum = Vec3::Zero();
  for (const ContactSample& c : sample.contacts) {
    const bool a = moves(scene.world.bodies[c.a]), b = moves(scene.world.bodies[c.b]);
    if (a && !b) sum += c.force;
    if (b && !a) sum -= c.force;
  }
  return sum;
}

}  // namespace

std::vector<ClaimRow> settledRows(const Scene& scene, const Recording& recording) {
  if (recording.samples.empty()) return {emptyClaim("the run has no samples")};
  const Sample& end = recording.samples.back();
  Vec3 load = Vec3::Zero();
  double fastest = 0.0, deepest = 0.0;
  for (int body = 0; body < static_cast<int>(scene.world.bodies.size()); ++body) {
    const BodyDef& def = scene.world.bodies[body];
    if (!moves(def)) continue;
    load += bodyMass(def) * freeAcceleration(scene.world, body).value_or(scene.world.gravity);
    const BodySample& seen = end.bodies[body];
    const double turning = seen.omega.norm() * boundingRadius(def.shape);
    fastest = std::max({fastest, seen.v.norm(), turning});
  }
  if (load.isZero()) return {emptyClaim("nothing has any weight")};
  for (const ContactSample& contact : end.contacts)
    deepest = std::max(deepest, -contact.separation);
  const Vec3 carried = groundForce(scene, end);
  return {{"carried at the end / N, relative", carried.norm(), load.norm(),
           (carried + load).norm() / load.norm(), kWeight},
          {"fastest point at the end / (m/s)", fastest, 0.0, fastest, kSpeed},
          {"deepest overlap at the end / m", deepest, 0.0, deepest, kOverlap}};
}

}  // namespace tumble
