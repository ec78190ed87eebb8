// Painlevé's paradox among what rests: where there are no forces, an impulse ends a slip.
#include <algorithm>

#include "sim/contact/jam.h"
#include "sim/method/exact/exact.h"

namespace tumble {

bool Exact::endJam(double t, const Cluster& cluster, const std::vector<Contact>& resting,
                   double residual) {
  const bool unsolved = state_.exact.jammed || !(residual < kNoForces);
  state_.exact.jammed = false;
  if (!unsolved &&
      std::none_of(resting.begin(), resting.end(), [](const Contact& c) { return c.sliding; }))
    return false;
  std::vector<RigidBody> bodies;
  std::vector<int> local(state_.bodies.size(), -1);
  for (const int i : cluster.bodies) {
    local[i] = static_cast<int>(bodies.size());
    bodies.push_back(state_.bodies[i]);
    bodies.back().force = state_.exact.outer[i];
    bodies.back().torque.setZero();
  }
  std::vector<Contact> contacts = resting;
  for (Contact& c : contacts) c.a = local[c.a], c.b = local[c.b];
  if (!unsolved && !jams(bodies, contacts)) return false;

  std::vector<Vec3> given(contacts.size(), Vec3::Zero());
  const std::vector<double> restitution(contacts.size(), 0.0);
  ImpulseEnergy energy;
  if (!tumble::endJam({bodies, contacts, restitution, given, tolerance_}, state_.kineticMax,
                      energy))
    return false;
  report_.certificate.energy_lost_friction += energy.lost;
  report_.certificate.work_of_forces += energy.work;
  for (const int i : cluster.bodies)
    if (!model_.fixed(i)) state_.bodies[i] = bodies[local[i]];
  recordImpacts(t, {.bodies = cluster.bodies, .contacts = resting},
                std::vector<double>(resting.size(), 0.0), given);
  report_.note(kJamNote);
  return true;
}

}  // namespace tumble
