#include "sim/method/exact/corners.h"

#include <algorithm>
#include <cmath>

#include "sim/collide/features.h"

namespace tumble {
namespace {

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
  const Vec3 ea =
      edgeOf(state.exact.parts[c.a], state.bodies[c.a], featureOfA(c.point.feature)).along;
  const Vec3 eb =
      edgeOf(state.exact.parts[c.b], state.bodies[c.b], featureOfB(c.point.feature)).along;
  if (ea.cross(eb).norm() < kCrossing) return;
  c.point.ea = ea;
  c.point.eb = eb;
  c.point.crosses = true;
}

/// Ties a contact of a face to its edges, if these lean. @return whether the solids touch there
bool tieEdges(const State& state, Contact& c) {
  if (c.point.tie != NormalTie::FaceOfA && c.point.tie != NormalTie::FaceOfB) return true;
  const RigidBody &a = state.bodies[c.a], &b = state.bodies[c.b];
  const BoxEdge ofA = edgeOf(state.exact.parts[c.a], a, featureOfA(c.point.feature));
  const BoxEdge ofB = edgeOf(state.exact.parts[c.b], b, featureOfB(c.point.feature));
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

void tieCrossings(const State& state, std::vector<Contact>& contacts) {
  for (Contact& c : contacts) {
    if (c.point.tie == NormalTie::FaceOfB || c.point.tie == NormalTie::FaceOfA)
      tieCrossing(state, c);
    c.anchor = anchorOf(state.bodies[c.a], state.bodies[c.b], c.point);
  }
}

}  // namespace tumble
