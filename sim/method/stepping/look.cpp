// Any instant inside a step: between its two ends by the parabola that meets both. Contacts ride on
// the features that touched at its start.
#include "sim/method/stepping/stepping.h"

namespace tumble {

void lookStepping(const Model& /*model*/, const State& state, double t,
                  std::vector<RigidBody>& bodies, std::vector<Contact>& contacts,
                  std::vector<JointForce>& joints) {
  // The step that contains t, its end included; at the very start, the first one.
  const Segment* segment = nullptr;
  for (const Segment& s : state.trail)
    if (!segment || s.t0 < t) segment = &s;
  if (!segment) {
    bodies = state.bodies;
    contacts.clear();
    joints.clear();
    return;
  }
  const double h = segment->t1 - segment->t0, s = (t - segment->t0) / h;
  bodies = s < 1.0 ? segment->start : segment->end;
  for (std::size_t i = 0; i < bodies.size() && s > 0.0 && s < 1.0; ++i) {
    const RigidBody &start = segment->start[i], &end = segment->end[i];
    RigidBody& body = bodies[i];
    const Vec3 way = end.x - start.x, bend = h * end.v - way;
    body = end;
    body.x = start.x + s * way + (s * s - s) * bend;
    // The turn of one step is small: the chord between the two quaternions, back on the sphere.
    const double sign = start.q.dot(end.q) < 0.0 ? -s : s;
    body.q.coeffs() = ((1.0 - s) * start.q.coeffs() + sign * end.q.coeffs()).normalized();
    if (!body.fixed()) body.P = body.M * (way + (2.0 * s - 1.0) * bend) / h;
    updateDerived(body);
  }
  joints = segment->joints;
  contacts = segment->contacts;
  for (Contact& c : contacts) {
    c.anchor = anchorOf(segment->start[c.a], segment->start[c.b], c.point);
    follow(bodies[c.a], bodies[c.b], c);
  }
}

}  // namespace tumble
