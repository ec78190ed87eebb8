// Any instant inside a step: between its two ends by the parabola that meets both, with the
// velocity of its end. Contacts ride on the features that touched at its start.
#include <algorithm>

#include "sim/math/rotation.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {
namespace {

/// Whether nothing twists a body in a step of h seconds; or it turns so far in it that the step
/// does not show how.
bool turnsSteadily(const RigidBody& start, const RigidBody& end, double h) {
  constexpr double kFar = 1.0;  // [rad]
  return end.fixed() || end.particle || start.L == end.L || h * end.omega.norm() > kFar;
}

/// A body at the part s of the way from one state to another, which takes h seconds.
RigidBody between(const RigidBody& start, const RigidBody& end, double s, double h) {
  constexpr double kEnd = 1e-9;  // of a step: an instant as near to one of its ends is that end
  if (!(s > kEnd) || !(s < 1.0 - kEnd)) return s < 0.5 ? start : end;
  const Vec3 way = end.x - start.x, bend = h * end.v - way;
  RigidBody body = end;
  body.x = start.x + s * way + (s * s - s) * bend;
  if (!body.fixed()) body.P = body.M * (way + (2.0 * s - 1.0) * bend) / h;
  if (turnsSteadily(start, end, h)) {
    // The turn of one step is small: the chord between the two quaternions, back on the sphere.
    const double sign = start.q.dot(end.q) < 0.0 ? -s : s;
    body.q.coeffs() = ((1.0 - s) * start.q.coeffs() + sign * end.q.coeffs()).normalized();
    updateDerived(body);
    return body;
  }
  const Vec3 turn = turnVector(end.q * start.q.conjugate()), lag = h * end.omega - turn;
  body.q = rotated(start.q, s * turn + (s * s - s) * lag).normalized();
  updateDerived(body);
  body.L = body.R * (body.Ibody * (body.R.transpose() * (turn + (2.0 * s - 1.0) * lag))) / h;
  updateVelocities(body);
  return body;
}

/// Whether an instant of a segment falls into a piece of it, its end included.
bool holds(const Segment& segment, const ClusterPart& piece, double t) {
  return t <= piece.t1 && (piece.t0 < t || piece.t0 == segment.t0);
}

/// Takes contacts along that touched at the start of a part.
void carry(std::span<const Contact> found, std::span<const RigidBody* const> start,
           std::span<const RigidBody> bodies, std::vector<Contact>& contacts) {
  for (Contact c : found) {
    c.anchor = anchorOf(*start[c.a], *start[c.b], c.point);
    follow(bodies[c.a], bodies[c.b], c);
    contacts.push_back(c);
  }
}

}  // namespace

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
  const auto at = [&](const RigidBody& start, const RigidBody& end, const auto& part) {
    const double h = part.t1 - part.t0;
    return between(start, end, (t - part.t0) / h, h);
  };
  bodies.clear();
  std::vector<const RigidBody*> start;
  for (std::size_t i = 0; i < segment->start.size(); ++i) {
    const RigidBody &first = segment->start[i], &last = segment->end[i];
    bodies.push_back(segment->still ? last : at(first, last, *segment));
    start.push_back(&segment->start[i]);
  }
  const auto forPieces = [&](const auto& visit) {
    for (const ClusterPart& piece : segment->pieces)
      if (holds(*segment, piece, t)) visit(piece);
  };
  forPieces([&](const ClusterPart& piece) {
    for (std::size_t k = 0; k < piece.bodies.size(); ++k)
      bodies[piece.bodies[k]] = at(piece.start[k], piece.end[k], piece);
  });
  joints = segment->joints;
  contacts.clear();
  carry(segment->contacts, start, bodies, contacts);
  forPieces([&](const ClusterPart& piece) {
    for (std::size_t k = 0; k < piece.bodies.size(); ++k) start[piece.bodies[k]] = &piece.start[k];
    carry(piece.contacts, start, bodies, contacts);
  });
  std::stable_sort(contacts.begin(), contacts.end(), [](const Contact& p, const Contact& q) {
    return std::pair(p.b, p.a) < std::pair(q.b, q.a);
  });
}

}  // namespace tumble
