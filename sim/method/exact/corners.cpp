#include "sim/method/exact/corners.h"

#include <algorithm>
#include <cmath>

#include "sim/collide/align.h"
#include "sim/collide/features.h"
#include "sim/math/frames.h"

namespace tumble {
namespace {

/// [1] Edges that lean by less against the face of a contact lie on it.
constexpr double kLevel = 1e-6;
/// [1/s] Edges on a face that turn against it by more are about to lean.
constexpr double kTurning = 1e-8;
/// [1] Rims that lean by less against the normal may come to lie flat.
constexpr double kLittle = 0.5;
/// [1] Edges that cross at less than this angle have no point to follow.
constexpr double kCrossing = 1e-3;

/// The edge of a box, or the rim of a cap, that a contact point is on: its direction there and the
/// outward normals of the faces beside it [1], world; zero if it is on none.
struct Border {
  Vec3 along = Vec3::Zero(), faces[2] = {Vec3::Zero(), Vec3::Zero()};
  /// Whether a solid that is outermost there along n may touch there.
  bool shows(const Vec3& n) const { return faces[0].dot(n) >= 0.0 && faces[1].dot(n) >= 0.0; }
};

/// @param rim  [m] radius of the rim that the point p [m] is on, in the direction `out` [1] from
///             its centre; 0 if it is on none
Border borderOf(const std::vector<Convex>& parts, const RigidBody& body, std::uint32_t code,
                double rim, const Vec3& out, const Vec3& p) {
  Border border;
  const std::size_t part = code >> 20;
  if (part >= parts.size()) return border;
  const Quat q = body.q * parts[part].pose.q;
  if (rim > 0.0) {
    const Vec3 axis = q * Vec3::UnitY(), middle = toWorld(body.pose(), parts[part].pose.x);
    border.along = axis.cross(out).normalized();
    border.faces[0] = (p - middle).dot(axis) < 0.0 ? Vec3(-axis) : axis;
    border.faces[1] = out;
    return border;
  }
  if ((code & kKindCode) != kEdgeCode || !std::holds_alternative<Box>(parts[part].shape))
    return border;
  const std::uint32_t number = code & (kEdgeCode - 1);
  const int axis = static_cast<int>(number >> 2);
  if (axis > 2) return border;
  border.along = q * Vec3::Unit(axis);
  border.faces[0] = q * Vec3(((number & 1) != 0 ? 1.0 : -1.0) * Vec3::Unit(nextAxis(axis)));
  border.faces[1] = q * Vec3(((number & 2) != 0 ? 1.0 : -1.0) * Vec3::Unit(lastAxis(axis)));
  return border;
}

Border borderOfA(const State& state, const Contact& c) {
  const ContactPoint& at = c.point;
  return borderOf(state.exact.parts[c.a], state.bodies[c.a], featureOfA(at.feature),
                  at.crosses ? at.rimA : 0.0, at.ea, at.pa);
}

Border borderOfB(const State& state, const Contact& c) {
  const ContactPoint& at = c.point;
  return borderOf(state.exact.parts[c.b], state.bodies[c.b], featureOfB(at.feature),
                  at.crosses ? at.rimB : 0.0, at.eb, at.pb);
}

/// Ties a contact that goes on in another way to its bodies anew.
void tieAnew(const State& state, Contact& c) {
  const RigidBody &a = state.bodies[c.a], &b = state.bodies[c.b];
  c.anchor = anchorOf(a, b, c.point);
  follow(a, b, c);
}

/// A contact tied to two edges or rims that cross there: the same point, with a normal that stays
/// across both.
Contact tiedToBoth(const State& state, const Contact& c, const Border& ofA, const Border& ofB) {
  Contact tied = c;
  ContactPoint& at = tied.point;
  if (!at.crosses || at.rimA == 0.0) at.ea = ofA.along;
  if (!at.crosses || at.rimB == 0.0) at.eb = ofB.along;
  at.tie = NormalTie::Edges;
  at.crosses = at.crosses && (at.rimA > 0.0 || at.rimB > 0.0);
  tieAnew(state, tied);
  return tied;
}

/// Ties a contact of a rim and an edge, or of two rims, to both as they cross, where a rim leans
/// little: as it comes to lie flat, the outermost point along n runs round it ever faster, and then
/// to its other side.
void tieRims(const State& state, Contact& c) {
  ContactPoint& at = c.point;
  const bool round = at.halfA.x() > 0.0 || at.halfB.x() > 0.0;
  const bool rims = at.tie == NormalTie::Points && at.rimA > 0.0 && at.rimB > 0.0,
             rimA = at.tie == NormalTie::EdgeOfB && at.rimA > 0.0,
             rimB = at.tie == NormalTie::EdgeOfA && at.rimB > 0.0;
  if (round || !(rims || rimA || rimB)) return;
  const RimPoint a = rimOfA(at), b = rimOfB(at);
  const Vec3 alongA = at.rimA > 0.0 ? a.along : at.ea, alongB = at.rimB > 0.0 ? b.along : at.eb;
  const double lean = std::min(a.lean, b.lean);
  if (!(lean < kLittle && alongA.cross(alongB).norm() > std::max(lean, kCrossing))) return;
  if (at.rimA > 0.0) at.ea = a.out;
  if (at.rimB > 0.0) at.eb = b.out;
  at.tie = NormalTie::Edges;
  at.crosses = true;
  tieAnew(state, c);
}

/// Ties the point of a contact of a face to the edges that cross there: as a point of the face, or,
/// where they are about to lean against it, as one of two edges, unless that would change a
/// velocity that is told from none [m/s].
void tieCrossing(const State& state, double rest, Contact& c) {
  const RigidBody &a = state.bodies[c.a], &b = state.bodies[c.b];
  const Border ofA = borderOfA(state, c), ofB = borderOfB(state, c);
  const Vec3 &ea = ofA.along, &eb = ofB.along;
  if (ea.cross(eb).norm() < kCrossing) return;
  const Vec3 across = c.point.n.cross(a.omega - b.omega);
  if (std::max(std::abs(across.dot(ea)), std::abs(across.dot(eb))) > kTurning) {
    const Contact tied = tiedToBoth(state, c, ofA, ofB);
    const double change = approachVelocity(a, b, tied.point) - approachVelocity(a, b, c.point);
    if (std::abs(change) <= rest) {
      c = tied;
      return;
    }
  }
  if (c.point.crosses) return;
  c.point.ea = ea;
  c.point.eb = eb;
  c.point.crosses = true;
}

/// Ties a contact of a face to its edges, if these lean; and one of edges to the normal of both:
/// where one of them ends, collide has another. @return whether the solids touch there
bool tieEdges(const State& state, Contact& c) {
  tieRims(state, c);
  if (c.point.tie == NormalTie::Edges && !c.point.crosses)
    c = tiedToBoth(state, c, {.along = c.point.ea}, {.along = c.point.eb});
  if (c.point.tie != NormalTie::FaceOfA && c.point.tie != NormalTie::FaceOfB) return true;
  const Border ofA = borderOfA(state, c), ofB = borderOfB(state, c);
  const double lean =
      std::max(std::abs(ofA.along.dot(c.point.n)), std::abs(ofB.along.dot(c.point.n)));
  if (ofA.along.cross(ofB.along).norm() < kCrossing || lean <= kLevel) return true;
  const Contact tied = tiedToBoth(state, c, ofA, ofB);
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
    tieRims(state, c);
    c.anchor = anchorOf(state.bodies[c.a], state.bodies[c.b], c.point);
  }
}

}  // namespace tumble
