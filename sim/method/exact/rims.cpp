#include "sim/method/exact/rims.h"

#include <algorithm>
#include <cmath>

namespace tumble {
namespace {

/// [1] A cap that leans by less lies flat.
constexpr double kFlat = 1e-6;

bool sameRim(const Contact& c, const Contact& d) {
  return c.anchor.rim.r > 0.0 && c.a == d.a && c.b == d.b && c.anchor.rim.r == d.anchor.rim.r &&
         c.anchor.rim.centre_B == d.anchor.rim.centre_B;
}

}  // namespace

void tieRims(const State& state, double close, std::vector<Contact>& contacts) {
  for (Contact& c : contacts) {
    const RigidBody &a = state.bodies[c.a], &b = state.bodies[c.b];
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
