// At the end everything lies still, and what never moves carries the weight of all the rest.
#include <algorithm>
#include <cmath>

#include "app/claim/free_body.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

// Allowed: of the weight, [m/s], [m]. Measured 7e-12, 1e-12, 2e-11.
constexpr double kWeight = 1e-9, kSpeed = 1e-6, kOverlap = 1e-9;

/// A quantity at its worst, and what it is of.
struct Worst {
  double value = 0.0;
  std::string name;

  void see(double seen, const std::string& of) {
    if (!name.empty() && seen <= value) return;
    value = seen;
    name = of;
  }
  ClaimRow row(const std::string& what, double allowed) const {
    return {name + ": " + what, value, 0.0, value, allowed};
  }
};

// The deepest overlap [m] of a pair; of nothing if nothing touches.
Worst deepestOf(const Scene& scene, const Sample& end) {
  Worst deepest;
  const auto name = [&](int body) { return scene.world.bodies[body].name; };
  for (const ContactSample& contact : end.contacts)
    deepest.see(std::max(0.0, -contact.separation), name(contact.a) + " on " + name(contact.b));
  if (deepest.name.empty()) deepest.name = "no contact";
  return deepest;
}

// Of what moves, by what does not [N].
Vec3 groundForce(const Scene& scene, const Sample& sample) {
  Vec3 sum = Vec3::Zero();
  for (const ContactSample& c : sample.contacts) {
    const bool a = moves(scene.world.bodies[c.a]), b = moves(scene.world.bodies[c.b]);
    if (a && !b) sum += c.force;
    if (b && !a) sum -= c.force;
  }
  const int world = static_cast<int>(scene.world.bodies.size());
  for (const JointForce& joint : sample.joints) {
    const bool a = moves(scene.world.bodies[joint.a]);
    const bool b = joint.b < world && moves(scene.world.bodies[joint.b]);
    if (a && !b) sum += joint.force;
    if (b && !a) sum -= joint.force;
  }
  return sum;
}

}  // namespace

std::vector<ClaimRow> settledRows(const Scene& scene, const Recording& recording) {
  if (recording.samples.empty()) return {emptyClaim("the run has no samples")};
  const Sample& end = recording.samples.back();
  Vec3 load = Vec3::Zero();
  Worst fastest;
  for (int body = 0; body < static_cast<int>(scene.world.bodies.size()); ++body) {
    const BodyDef& def = scene.world.bodies[body];
    if (!moves(def)) continue;
    load += bodyMass(def) * freeAcceleration(scene.world, body).value_or(scene.world.gravity);
    const BodySample& seen = end.bodies[body];
    const double turning = seen.omega.norm() * boundingRadius(def.shape);
    fastest.see(std::max(seen.v.norm(), turning), def.name);
  }
  if (load.isZero()) return {emptyClaim("nothing has any weight")};
  const Vec3 carried = groundForce(scene, end);
  return {{"all bodies: carried at the end / N, relative", carried.norm(), load.norm(),
           (carried + load).norm() / load.norm(), kWeight},
          fastest.row("fastest point at the end / (m/s)", kSpeed),
          deepestOf(scene, end).row("deepest overlap at the end / m", kOverlap)};
}

}  // namespace tumble
