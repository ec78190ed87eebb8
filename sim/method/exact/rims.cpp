#include "sim/method/exact/rims.h"

#include <algorithm>
#include <cmath>

#include "sim/collide/features.h"

namespace tumble {
namespace {

/// [1] A cap that leans by less lies flat.
constexpr double kFlat = 1e-6;
/// [1] Edges that lean by less against the face of a contact lie on it.
constexpr double kLevel = 1e-6;
/// [1] Edges that cross at less than this angle have no point to follow.
constexpr double kCrossing = 1e-3;

/// The edge of a box that a contact point is on, and the outward normals of the faces beside it
/// [1], world; zero if it is on none.
struct BoxEdge {
  Vec3 along = Vec3::Zero(), faces[2] = {Vec3::Zero(), Vec3::Zero()};
  /// Whether a solid that is outermost there along n may touch there.
  bool shows(const Vec3& n) const { return faces[0].dot(n) >= 0.0 && faces[1].dot(n) >= 0.0; }
};

BoxEdge edgeOf(const std::vector<Convex>& parts, const RigidBody& body, std::uint32_t code) {
  BoxEdge edge;
  const std::size_t part = code >> 20;
  if ((code & kKindCode) != kEdgeCode || part >= parts.size() ||
      !std::holds_alternative<Box>(parts[part].shape))
    return edge;
  const std::uint32_t number = code & (kEdgeCode - 1);
  const int axis = static_cast<int>(number >> 2);
  if (axis > 2) return edge;
  const Quat q = body.q * parts[part].pose.q;
  edge.along = q * Vec3::Unit(axis);
  edge.faces[0] = q * Vec3(((number & 1) != 0 ? 1.0 : -1.0) * Vec3::Unit(nextAxis(axis)));
  edge.faces[1] = q * Vec3(((number & 2) != 0 ? 1.0 : -1.0) * Vec3::Unit(lastAxis(axis)));
  return edge;
}

void tieCrossing(const State& state, Contact& c) {
  const Vec3 ea = edgeOf(state.parts[c.a], state.bodies[c.a], featureOfA(c.point.feature)).along;
  const Vec3 eb = edgeOf(state.parts[c.b], state.bodies[c.b], featureOfB(c.point.feature)).along;
  if (ea.cross(eb).norm() < kCrossing) return;
  c.point.ea = ea;
  c.point.eb = eb;
  c.point.bend = -1.0;
}

/// Ties a contact of a face to its edges, if these lean. @return whether the solids touch there
bool tieEdges(const State& state, Contact& c) {
  if (c.point.tie != NormalTie::FaceOfA && c.point.tie != NormalTie::FaceOfB) return true;
  const RigidBody &a = state.bodies[c.a], &b = state.bodies[c.b];
  const BoxEdge ofA = edgeOf(state.parts[c.a], a, featureOfA(c.point.feature));
  const BoxEdge ofB = edgeOf(state.parts[c.b], b, featureOfB(c.point.feature));
  const double lean =
      std::max(std::abs(ofA.along.dot(c.point.n)), std::abs(ofB.along.dot(c.point.n)));
  if (ofA.along.cross(ofB.along).norm() < kCrossing || lean <= kLevel) return true;
  Contact tied = c;
  tied.point.tie = NormalTie::Edges;
  tied.point.ea = ofA.along;
  tied.point.eb = ofB.along;
  tied.anchor = anchorOf(a, b, tied.point);
  follow(a, b, tied);
  const bool shows = ofA.shows(-tied.point.n) && ofB.shows(tied.point.n);
  if (shows) c = tied;
  return shows;
}

bool sameRim(const Contact& c, const Contact& d) {
  return c.anchor.rim.r > 0.0 && c.a == d.a && c.b == d.b && c.anchor.rim.r == d.anchor.rim.r &&
         c.anchor.rim.centre_B == d.anchor.rim.centre_B;
}

}  // namespace

void tieLeaning(const State& state, std::vector<Contact>& contacts) {
  std::vector<Contact> all;
  for (std::size_t first = 0, end = 0; first < contacts.size(); first = end) {
    std::vector<Contact> shown;
    for (end = first; end < contacts.size(); ++end) {
      Contact c = contacts[end];
      if (c.a != contacts[first].a || c.b != contacts[first].b) break;
      if (tieEdges(state, c)) shown.push_back(c);
    }
    const auto at = [&](std::size_t k) {
      return contacts.begin() + static_cast<std::ptrdiff_t>(k);
    };
    if (shown.empty()) shown.assign(at(first), at(end));
    all.insert(all.end(), shown.begin(), shown.end());
  }
  contacts = all;
}

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
