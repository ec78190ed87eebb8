// The contact problem of an island: its bodies, and rows for all that joins them.
#include <algorithm>
#include <limits>

#include "sim/contact/rows.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {

/// Number of a body in the problem of its island.
int Stepping::localOf(Island& island, int body) {
  if (island.local[body] < 0) {
    island.local[body] = static_cast<int>(island.problem.invM.size());
    const bool world = body == static_cast<int>(state_.bodies.size());
    const int drag = world || isHalved(body) ? -1 : memory_.drives->dragOf[body];
    const double share = drag < 0 ? 1.0 : work_.drags[drag].way.mean;
    island.problem.invM.push_back(world ? 0.0 : share * state_.bodies[body].invM);
    if (world)
      island.problem.Iinv.push_back(Mat3::Zero());
    else
      island.problem.Iinv.push_back(drag < 0 ? state_.bodies[body].Iinv : work_.drags[drag].Iinv);
    island.problem.vStar.push_back(work_.star[body]);
    island.solution.v.push_back(work_.before[body]);
    island.bodies.push_back(body);
  }
  return island.local[body];
}

void Stepping::build(Island& island, double h) {
  island.problem.invM.clear();
  island.problem.Iinv.clear();
  island.problem.vStar.clear();
  island.problem.rows.clear();
  island.problem.cones.clear();
  island.problem.couplings.clear();
  island.solution.lambda.clear();
  island.solution.v.clear();
  island.solution.pull.clear();
  island.pull.clear();
  for (const int i : island.bodies) island.local[i] = -1;
  island.bodies.clear();
  if (bends() && anyBends(island))
    for (const int i : island.movers) localOf(island, i);
  for (const Link link : island.links) {
    if (isPair(link)) {
      addPair(island, memory_.pairs[link].touches, h);
      continue;
    }
    island.problem.cones.push_back({.kind = work_.bonds.kinds[link - state_.near.size()],
                                    .row = static_cast<int>(island.problem.rows.size())});
    addRow(island, bondOf(link));
    island.pull.push_back(unknown()[0]);
  }
}

/// Adds a row between bodies of the world as one between bodies of the island.
Row& Stepping::addRow(Island& island, const Row& row) {
  Row& added = island.problem.rows.emplace_back(row);
  added.a = localOf(island, row.a);
  added.b = localOf(island, row.b);
  return added;
}

/// A gap may be closed by the end of the step and no further. Where all touch, none is left. Else
/// the least gap, if that one touches, is closed in a whole step, as rounding would make it a speed
/// in a part; and the others go with it: one motion closes all gaps of a face, and rounding does
/// not tell which of its corners is left out.
double Stepping::gapRate(const Touch& touch, const Room& room, double h) const {
  if (room.allClosed) return 0.0;
  const double gap = std::max(touch.contact.point.separation, -tolerance_.root);
  return (gap - room.least) / h + room.least / std::max(h, model_.def.stepping.step);
}

Stepping::Room Stepping::roomOf(std::span<const Touch> touches) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Touch& touch : touches) least = std::min(least, touch.contact.point.separation);
  return {.allClosed = areClosed(touches),
          .least = least <= tolerance_.touch ? std::max(least, -tolerance_.root) : 0.0};
}

bool Stepping::areClosed(std::span<const Touch> touches) const {
  return std::all_of(touches.begin(), touches.end(),
                     [&](const Touch& touch) { return closed(touch); });
}

/// Moves the points of a face, or an edge, along its normal into the plane of the one with the
/// least gap. Where two of them stick, their velocities along the line between them are one and the
/// same: were that line tilted, by gaps that are not closed yet, no velocities would stop both
/// while the gaps close, and a little slip, a tilt times a tilt, would decide between forces that
/// lie far apart.
void Stepping::level(Island& island) const {
  constexpr double kSame = 1e-12;  // [rad] between two normals that are one
  std::vector<const Stance*>& faces = island.faces;
  faces.clear();
  // Points lie midway in their gaps.
  const auto faceOf = [&](const ContactPoint& c) {
    return std::find_if(faces.begin(), faces.end(), [&](const Stance* face) {
      const ContactPoint& f = face->point;
      const double gaps = 0.5 * std::abs(f.separation - c.separation);
      return (f.n - c.n).squaredNorm() <= kSame * kSame &&
             std::abs(c.n.dot(f.p - c.p)) <= gaps + tolerance_.touch;
    });
  };
  for (const Stance& stance : island.stances) {
    const auto face = faceOf(stance.point);
    if (face == faces.end())
      faces.push_back(&stance);
    else if (stance.point.separation < (*face)->point.separation)
      *face = &stance;
  }
  for (Stance& stance : island.stances) {
    ContactPoint& c = stance.point;
    const auto face = faceOf(c);
    if (face != faces.end()) c.p += c.n.dot((*face)->point.p - c.p) * c.n;
  }
}

void Stepping::addPair(Island& island, std::vector<Touch>& touches, double h) {
  const Room room = roomOf(touches);
  std::vector<Stance>& stances = island.stances;
  stances.clear();
  for (Touch& touch : touches) {
    if (flies(touch, h)) continue;
    const Contact& c = touch.contact;
    stances.push_back(island.smooth
                          ? inMiddle(touch, h)
                          : Stance{&touch, c.point, state_.bodies[c.a].x, state_.bodies[c.b].x});
  }
  level(island);
  if (island.follows())
    for (Stance& stance : stances) stance.closes = closing(touches, h);
  for (const Stance& stance : stances) addTouch(island, stance, room, h);
}

/// Adds a point of a pair that is so far apart.
void Stepping::addTouch(Island& island, const Stance& at, const Room& room, double h) {
  Touch& touch = *at.touch;
  const Contact& contact = touch.contact;
  const RigidBody &bodyA = state_.bodies[contact.a], &bodyB = state_.bodies[contact.b];
  const ContactPoint& c = at.point;
  const auto addAlong = [&](const Vec3& d) -> Row& {
    island.pull.push_back(touch.pull.dot(d));
    return addRow(island, pointRow(contact.a, contact.b, at.a, at.b, c.p, d, 0.0));
  };
  Cone& cone = island.problem.cones.emplace_back(
      Cone{.kind = ConeKind::Push, .row = static_cast<int>(island.problem.rows.size())});
  Row& normal = addAlong(c.n);

  const double vrel = rowSpeed(normal, work_.before[contact.a], work_.before[contact.b]);
  touch.approach = std::max(touch.arrivalSpeed, -vrel);
  if (c.beside) {
    const Vec6 &starA = work_.star[contact.a], &starB = work_.star[contact.b];
    normal.bias =
        gapBeside(c, {contact.b, contact.a}, starA, starB, h) / h - rowSpeed(normal, starA, starB);
  } else {
    normal.bias = gapRate(touch, room, h);
    if (island.follows()) normal.bias += wanders(at) + at.closes;
  }
  if (reboundsInStep() && !isAside(touch) && !c.beside) rebound(touch, vrel, h, normal);
  const Vec3 lead = carried(contact, h);
  if (model_.fixed(contact.a) || model_.fixed(contact.b)) normal.bias += c.n.dot(lead);
  if (contact.friction <= 0.0) return;
  cone.kind = ConeKind::Friction;
  cone.mu = contact.friction;
  Vec3 t1, t2;
  const Vec3 slip = slipVelocity(bodyA, bodyB, contact.point);
  tangents(c.n, slip, t1, t2);
  // Friction is against the slip at the end of the step or, where it slips on, in its middle.
  const bool slipsOn = island.smooth && slip.norm() > tolerance_.stick;
  for (const Vec3& t : {t1, t2}) {
    Row& row = addAlong(t);
    row.bias =
        slipsOn ? rowSpeed(row, work_.before[contact.a], work_.before[contact.b]) : t.dot(lead);
  }
}

}  // namespace tumble
