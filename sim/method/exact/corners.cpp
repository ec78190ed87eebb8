#include "sim/method/exact/corners.h"

#include <algorithm>
#include <cmath>

#include "sim/collide/features.h"

namespace tumble {
namespace {

/// [1] Edges that lean by less against the face of a contact lie on it.
constexpr double kLevel = 1e-6;
/// [1/s] Edges on a face that turn against it by more are about to lean.
constexpr double kTurning = 1e-8;
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

/// A contact tied to two edges that cross there: the same point, with a normal that stays across
/// both.
Contact tiedToEdges(const State& state, const Contact& c, const Vec3& ea, const Vec3& eb) {
  const RigidBody &a = state.bodies[c.a], &b = state.bodies[c.b];
  Contact tied = c;
  tied.point.tie = NormalTie::Edges;
  tied.point.ea = ea;
  tied.point.eb = eb;
  tied.anchor = anchorOf(a, b, tied.point);
  follow(a, b, tied);
  return tied;
}

/// Ties the point of a contact of a face to the edges that cross there: as a point of the face, or,
/// where they are about to lean against it, as one of two edges, unless that would change a
/// velocity that is told from none [m/s].
void tieCrossing(const State& state, double rest, Contact& c) {
  const RigidBody &a = state.bodies[c.a], &b = state.bodies[c.b];
  const Vec3 ea = edgeOf(state.exact.parts[c.a], a, featureOfA(c.point.feature)).along;
  const Vec3 eb = edgeOf(state.exact.parts[c.b], b, featureOfB(c.point.feature)).along;
  if (ea.cross(eb).norm() < kCrossing) return;
  const Vec3 across = c.point.n.cross(a.omega - b.omega);
  if (std::max(std::abs(across.dot(ea)), std::abs(across.dot(eb))) > kTurning) {
    const Contact tied = tiedToEdges(state, c, ea, eb);
    const double change = approachVelocity(a, b, tied.point) - approachVelocity(a, b, c.point);
    if (std::abs(change) <= rest) {
      c = tied;
      return;
    }
  }
  c.point.ea = ea;
  c.point.eb = eb;
  c.point.crosses = true;
}

/// Ties a contact of a face to its edges, if these lean; and one of edges to the normal of both:
/// where one of them ends, collide has another. @return whether the solids touch there
bool tieEdges(const State& state, Contact& c) {
  if (c.point.tie == NormalTie::Edges) c = tiedToEdges(state, c, c.point.ea, c.point.eb);
  if (c.point.tie != NormalTie::FaceOfA && c.point.tie != NormalTie::FaceOfB) return true;
  const RigidBody &a = state.bodies[c.a], &b = state.bodies[c.b];
  const BoxEdge ofA = edgeOf(state.exact.parts[c.a], a, featureOfA(c.point.feature));
  const BoxEdge ofB = edgeOf(state.exact.parts[c.b], b, featureOfB(c.point.feature));
  const double lean =
      std::max(std::abs(ofA.along.dot(c.point.n)), std::abs(ofB.along.dot(c.point.n)));
  if (ofA.along.cross(ofB.along).norm() < kCrossing || lean <= kLevel) return true;
  const Contact tied = tiedToEdges(state, c, ofA.along, ofB.along);
  const bool shows = ofA.shows(-tied.point.n) && ofB.shows(tied.point.n);
  if (shows) c = tied;
  return shows;
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

void tieCrossings(const State& state, double rest, std::vector<Contact>& contacts) {
  for (Contact& c : contacts) {
    if (c.point.tie == NormalTie::FaceOfB || c.point.tie == NormalTie::FaceOfA)
      tieCrossing(state, rest, c);
    c.anchor = anchorOf(state.bodies[c.a], state.bodies[c.b], c.point);
  }
}

}  // namespace tumble
