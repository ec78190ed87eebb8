#include "app/present/arrows.h"

#include <algorithm>

#include "app/claim/free_body.h"
#include "app/present/palette.h"
#include "sim/math/frames.h"

namespace tumble {

double largestContactForce(const Recording& recording) {
  std::vector<double> forces;
  for (const Sample& sample : recording.samples)
    for (const ContactSample& contact : sample.contacts)
      if (!contact.force.isZero()) forces.push_back(contact.force.norm());
  if (forces.empty()) return 1.0;
  // In a run that comes to rest the largest force that lasts is within the lowest 98 %.
  const std::size_t index = forces.size() - 1 - forces.size() / 50;
  std::nth_element(forces.begin(), forces.begin() + static_cast<std::ptrdiff_t>(index),
                   forces.end());
  return forces[index];
}

void addContactForces(const Sample& sample, double fmax, double length, Picture& picture) {
  for (const ContactSample& contact : sample.contacts) {
    const Vec3 force = contact.force.y() < 0.0 ? Vec3(-contact.force) : contact.force;
    const double share = std::min(1.0, force.norm() / fmax);
    if (share < 1e-3) continue;
    const Vec3 tip = contact.p + share * length * force.normalized();
    picture.arrows.push_back(
        {contact.p, tip, colour::kForce, static_cast<float>(1.5 + 0.6 * share)});
  }
}

void addNormals(const Sample& sample, double length, Picture& picture) {
  for (const ContactSample& contact : sample.contacts)
    picture.arrows.push_back({contact.p, contact.p + length * contact.n, colour::kInk, 1.3f});
}

void addVelocities(const Scene& scene, const Recording& recording, const Sample& sample,
                   double length, Picture& picture) {
  double fastest = 0.0;
  for (const Sample& other : recording.samples)
    for (const BodySample& body : other.bodies) fastest = std::max(fastest, body.v.norm());
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodySample& body = sample.bodies[i];
    if (!moves(scene.world.bodies[i]) || body.v.norm() < 0.01 * fastest) continue;
    const Vec3 base = body.x + reach(scene.world.bodies[i].shape, body.q, body.v.normalized()) *
                                   body.v.normalized();
    picture.arrows.push_back({base, base + length / fastest * body.v, colour::kVelocity, 1.9f});
  }
}

namespace {

/// A force [N] on a body, whose arrow ends at `tip`.
struct Push {
  Vec3 tip, force;
};

// An arrow towards the centre of mass ends on the body's surface.
Push pushAtCentre(const BodyDef& def, const BodySample& body, const Vec3& force) {
  const Vec3 along = force.normalized();
  return {body.x - reach(def.shape, body.q, along) * along, force};
}

std::vector<Push> pushes(const Scene& scene, const Sample& sample) {
  std::vector<Push> found;
  const std::vector<BodyDef>& bodies = scene.world.bodies;
  for (const Force& force : scene.world.forces) {
    if (const UniformWind* wind = std::get_if<UniformWind>(&force)) {
      for (std::size_t i = 0; i < bodies.size(); ++i)
        if (moves(bodies[i]) && (wind->body == kNoBody || wind->body == static_cast<int>(i)))
          found.push_back(pushAtCentre(bodies[i], sample.bodies[i], wind->force));
    } else if (const PointForce* point = std::get_if<PointForce>(&force)) {
      const BodySample& body = sample.bodies[point->body];
      found.push_back({toWorld({body.x, body.q}, point->point_B), point->force});
    }
  }
  return found;
}

}  // namespace

void addForces(const Scene& scene, const Sample& sample, double length, Picture& picture,
               double scale) {
  const std::vector<Push> found = pushes(scene, sample);
  double largest = 0.0;
  for (const Push& push : found) largest = std::max(largest, push.force.norm());
  if (largest == 0.0) return;
  const double metres = scale > 0.0 ? scale : length / largest;
  for (const Push& push : found)
    picture.arrows.push_back(
        {push.tip - metres * push.force, push.tip, colour::kForce, scale > 0.0 ? 2.6f : 1.6f});
}

}  // namespace tumble
