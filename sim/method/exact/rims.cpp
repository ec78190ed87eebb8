#include "sim/method/exact/rims.h"

#include <algorithm>
#include <cmath>

#include "sim/collide/features.h"

namespace tumble {
namespace {

/// [1] A cap that leans by less lies flat.
constexpr double kFlat = 1e-6;
/// [1] Edges that cross at less than this angle have no point to follow.
constexpr double kCrossing = 1e-3;

/// Direction [1] of the edge of a box that a contact point is on, world; zero if it is on none.
Vec3 edgeOf(const std::vector<Convex>& parts, const RigidBody& body, std::uint32_t code) {
  const std::size_t part = code >> 20;
  if ((code & kKindCode) != kEdgeCode || part >= parts.size() ||
      !std::holds_alternative<Box>(parts[part].shape))
    return Vec3::Zero();
  const int axis = static_cast<int>((code & (kEdgeCode - 1)) >> 2);
  return axis < 3 ? Vec3(body.q * parts[part].pose.q * Vec3::Unit(axis)) : Vec3(Vec3::Zero());
}

void tieCrossing(const State& state, Contact& c) {
  const Vec3 ea = edgeOf(state.parts[c.a], state.bodies[c.a], featureOfA(c.point.feature));
  const Vec3 eb = edgeOf(state.parts[c.b], state.bodies[c.b], featureOfB(c.point.feature));
  if (ea.cross(eb).norm() < kCrossing) return;
  c.point.ea = ea;
  c.point.eb = eb;
  c.point.bend = -1.0;
}

bool sameRim(const Contact& c, const Contact& d) {
  return c.anchor.rim.r > 0.0 && c.a == d.a && c.b == d.b && c.anchor.rim.r == d.anchor.rim.r &&
         c.anchor.rim.centre_B == d.anchor.rim.centre_B;
}

}  // namespace

void tieRims(const State& state, double close, std::vector<Contact>& contacts) {
  for (Contact& c : contacts) {
    const RigidBody &a = state.bodies[c.a], &b = state.bodies[c.b];
    if (c.point.tie == NormalTie::FaceOfB || c.point.tie == NormalTie::FaceOfA)
      tieCrossing(state, c);
    c.anchor = anchorOf(a, b, c.point);
    const bool onA = c.point.tie == NormalTie::FaceOfB, onB = c.point.tie == NormalTie::FaceOfA;
    if ((!onA && !onB) || (onA ? c.point.ra : c.point.rb) > 0.0) continue;
    const Vec3 p = onA ? c.anchor.pa_B : c.anchor.pb_B;
    const Vec3 n = (onA ? a : b).q.conjugate() * c.point.n;
    for (const Convex& part : state.parts[onA ? c.a : c.b])
      for (const Outline::Rim& rim : part.outline.rims) {
        const Vec3 axis = rim.u.cross(rim.v), arm = p - rim.centre;
        const bool on = std::abs(arm.dot(axis)) <= close && std::abs(arm.norm() - rim.r) <= close;
        if (on && n.cross(axis).norm() > kFlat) c.anchor.rim = {rim.centre, axis, rim.r};
      }
    if (c.anchor.rim.r > 0.0) follow(a, b, c);
  }
  for (std::size_t k = 0; k < contacts.size(); ++k)
    contacts.erase(
        std::remove_if(contacts.begin() + static_cast<std::ptrdiff_t>(k) + 1, contacts.end(),
                       [&](const Contact& d) { return sameRim(contacts[k], d); }),
        contacts.end());
}

}  // namespace tumble
