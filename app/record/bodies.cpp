#include "app/record/bodies.h"

#include "sim/body/mass_properties.h"

namespace tumble {

bool moves(const BodyDef& body) {
  return !body.fixed && !std::holds_alternative<HalfSpace>(body.shape);
}

std::vector<RigidBody> bodiesAt(const WorldDef& world, const Sample& sample) {
  std::vector<RigidBody> bodies;
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodySample& at = sample.bodies[i];
    const BodyDef& def = world.bodies[i];
    if (!moves(def)) {
      bodies.push_back(makeFixedBody({at.x, at.q}, at.v, at.omega));
      continue;
    }
    const bool particle = std::holds_alternative<Particle>(def.shape);
    RigidBody& body =
        bodies.emplace_back(particle ? makeParticle(bodyMass(def)) : makeBody(massOf(def)));
    body.x = at.x;
    body.q = at.q;
    updateDerived(body);
    setVelocity(body, at.v, at.omega);
  }
  return bodies;
}

std::vector<RigidBody> loadedBodiesAt(const WorldDef& world, const Sample& sample) {
  std::vector<RigidBody> bodies = bodiesAt(world, sample);
  sumForces(world.gravity, world.forces, bodies);
  for (const ContactSample& c : sample.contacts) {
    applyForce(bodies[c.a], c.p, c.force);
    applyForce(bodies[c.b], c.p, -c.force);
  }
  for (const JointForce& joint : sample.joints) {
    applyForce(bodies[joint.a], joint.p, joint.force);
    bodies[joint.a].torque += joint.torque;
    if (joint.b >= static_cast<int>(bodies.size())) continue;
    applyForce(bodies[joint.b], joint.p, -joint.force);
    bodies[joint.b].torque -= joint.torque;
  }
  return bodies;
}

}  // namespace tumble
