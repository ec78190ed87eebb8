// Where contacts are, how fast they go and how they go on: one file, for all three share the
// geometry of edges, rims and what is round.
#include "sim/contact/contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/collide/align.h"
#include "sim/collide/crossing_point.h"
#include "sim/collide/ellipsoid.h"
#include "sim/math/frames.h"

namespace tumble {
namespace {

/// The part of v across the unit vector n.
Vec3 across(const Vec3& v, const Vec3& n) {
  return v - v.dot(n) * n;
}

/// Distance pa − pb along n [m].
double reach(const ContactPoint& c) {
  return c.separation + c.ra + c.rb;
}

/// p lies midway between the two surfaces.
void placeBetween(ContactPoint& c) {
  c.p = 0.5 * ((c.pa - c.ra * c.n) + (c.pb + c.rb * c.n));
}

/// n along the offset u, which has the length of the reach.
void alongOffset(ContactPoint& c, const Vec3& u) {
  const double length = u.norm();
  if (length > 0.0) c.n = u / length;
  c.separation = c.n.dot(u) - c.ra - c.rb;
}

/// Moves pa and pb along their edges to where the two lines are nearest.
void nearestOnEdges(ContactPoint& c) {
  const Vec3 d = c.pa - c.pb;
  const double k = c.ea.dot(c.eb), det = 1.0 - k * k;
  const double da = d.dot(c.ea), db = d.dot(c.eb);
  c.pa += ((k * db - da) / det) * c.ea;
  c.pb += ((db - k * da) / det) * c.eb;
}

/// Moves the point of a contact of a face to where edges cross, or a rim is outermost.
void placeOnFace(ContactPoint& c) {
  if (c.crosses && (c.rimA > 0.0 || c.rimB > 0.0)) return alignCrossing(c, Vec3(c.pa), Vec3(c.pb));
  if (c.crosses) return nearestOnEdges(c);
  if (c.rimA > 0.0) c.pa += c.rimA * rimOfA(c).out;
  if (c.rimB > 0.0) c.pb += c.rimB * rimOfB(c).out;
}

/// How a contact goes on. Edges that have come to lie along each other cross nowhere: a point of a
/// goes along the edge of b, or, as sharp edges have no direction, along a face that n stands for.
NormalTie tieOf(const ContactPoint& c) {
  constexpr double kParallel = 1e-6;  // sine
  if (c.tie != NormalTie::Edges || c.crosses || c.ea.cross(c.eb).norm() > kParallel) return c.tie;
  return c.ra + c.rb > 0.0 ? NormalTie::EdgeOfB : NormalTie::FaceOfB;
}

bool hasRim(const ContactPoint& c) {
  return c.rimA > 0.0 || c.rimB > 0.0;
}

/// Whether the place of contact goes round a rim, and n with it.
bool rolls(const ContactPoint& c) {
  return hasRim(c) && (isSlant(c) || !c.crosses);
}

/// Centre of the rim that a point is on; the point itself if there is none.
Vec3 centreOf(const Vec3& p, double r, const Vec3& e, const Vec3& outward, bool crosses) {
  if (r == 0.0) return p;
  return p - r * (crosses ? e : outermostOnRim(e, r, outward).out);
}

/// How a contact goes on where a rim touches.
struct Rolling {
  Vec3 rate;              ///< [1/s] ṅ
  Vec3 wanderA, wanderB;  ///< [m/s] of pa over a, and of pb over b
};

/// ṅ where only the part of the motion across an edge turns n, or nothing holds it:
///   t·(n·(pa − pb) ṅ + Σ bend (along·ṅ) along) = t·w  along free tangents t,  ṅ·e = −n·ė
/// @param w  [m/s] ṗa − ṗb of material points and of rims that turn under a steady n
Vec3 freeRate(const ContactPoint& c, const RimPoint& a, const RimPoint& b, const Vec3& w,
              const Vec3* edge, const Vec3& edgeRate) {
  const auto bent = [&](const Vec3& t, const Vec3& u) {
    return a.bend * a.along.dot(t) * a.along.dot(u) + b.bend * b.along.dot(t) * b.along.dot(u);
  };
  const double d = reach(c);
  if (edge) {
    const Vec3 t = edge->cross(c.n);
    const double beside = -c.n.dot(edgeRate);
    return ((t.dot(w) - bent(t, *edge) * beside) / (d + bent(t, t))) * t + beside * *edge;
  }
  const Vec3 t = c.n.unitOrthogonal(), u = c.n.cross(t);
  const double tt = d + bent(t, t), uu = d + bent(u, u), tu = bent(t, u);
  const double det = tt * uu - tu * tu, wt = t.dot(w), wu = u.dot(w);
  return ((uu * wt - tu * wu) / det) * t + ((tt * wu - tu * wt) / det) * u;
}

/// Where edges or rims cross at a slant, points wander along both so that their offset stays
/// square to them, and n = ± τa×τb turns with the tangents.
Rolling crossingOf(const RigidBody& a, const RigidBody& b, const ContactPoint& c) {
  const Slant slant(c);
  const Vec3 &ta = slant.ta, &tb = slant.tb, way = c.pa - c.pb;
  const Vec3 relative = pointVelocity(a, c.pa) - pointVelocity(b, c.pb);
  const Vec3 turnA = a.omega.cross(ta), turnB = b.omega.cross(tb);
  const auto [alongA, alongB] =
      slant.ways(ta.dot(relative) + way.dot(turnA), tb.dot(relative) + way.dot(turnB));
  const Vec3 rateA = turnA + alongA * slant.bendA, rateB = turnB + alongB * slant.bendB;
  const Vec3 product = ta.cross(tb);
  const Vec3 rate = across(rateA.cross(tb) + ta.cross(rateB), c.n) / product.dot(c.n);
  return {rate, alongA * ta, alongB * tb};
}

Rolling rollingOf(const RigidBody& a, const RigidBody& b, const ContactPoint& c) {
  if (isSlant(c)) return crossingOf(a, b, c);
  const RimPoint rimA = rimOfA(c), rimB = rimOfB(c);
  const auto runs = [](const RimPoint& rim, const Vec3& turn) {
    return Vec3(rim.bend * rim.along.dot(turn) * rim.along);
  };
  const Vec3 turnA = a.omega.cross(c.n), turnB = b.omega.cross(c.n);
  const Vec3 relative = pointVelocity(a, c.pa) - pointVelocity(b, c.pb);
  const Vec3 w = relative + runs(rimA, turnA) + runs(rimB, turnB);
  Rolling roll;
  switch (c.tie) {
    case NormalTie::FaceOfB:
      roll.rate = turnB;
      break;
    case NormalTie::FaceOfA:
      roll.rate = turnA;
      break;
    case NormalTie::EdgeOfB:
      roll.rate = freeRate(c, rimA, rimB, w, &c.eb, b.omega.cross(c.eb));
      break;
    case NormalTie::EdgeOfA:
      roll.rate = freeRate(c, rimA, rimB, w, &c.ea, a.omega.cross(c.ea));
      break;
    default:
      roll.rate = freeRate(c, rimA, rimB, w, nullptr, Vec3::Zero());
  }
  roll.wanderA = -runs(rimA, roll.rate - turnA);
  roll.wanderB = runs(rimB, roll.rate - turnB);
  // Feet follow what they are the feet of.
  const Vec3 apart = reach(c) * roll.rate;
  if (c.tie == NormalTie::FaceOfB || c.tie == NormalTie::EdgeOfB)
    roll.wanderB = across(relative + roll.wanderA - apart, c.n);
  if (c.tie == NormalTie::FaceOfA || c.tie == NormalTie::EdgeOfA)
    roll.wanderA = across(apart + roll.wanderB - relative, c.n);
  return roll;
}

}  // namespace

double ContactTolerance::scaleOf(double size) {
  return std::max(size, std::min(1.0, size / kSmall));
}

ContactTolerance ContactTolerance::forSize(double size) {
  ContactTolerance t;
  const double s = scaleOf(size);
  t.touch *= s;
  t.root *= s;
  t.drift *= s;
  t.rest *= s;
  t.keep *= s;
  t.stick *= s;
  return t;
}

[[gnu::flatten]] double approachVelocity(const RigidBody& a, const RigidBody& b,
                                         const ContactPoint& c) {
  return c.n.dot(pointVelocity(a, c.p) - pointVelocity(b, c.p));
}

[[gnu::flatten]] Vec3 slipVelocity(const RigidBody& a, const RigidBody& b, const ContactPoint& c) {
  return across(pointVelocity(a, c.p) - pointVelocity(b, c.p), c.n);
}

bool hasTurned(const Contact& c, const Vec3& slip) {
  return !(slip.dot(c.slipDirection) > 0.5 * slip.norm());
}

ContactClass classify(double vrel, double tolerance) {
  if (vrel < -tolerance) return ContactClass::Colliding;
  return vrel > tolerance ? ContactClass::Separating : ContactClass::Resting;
}

[[gnu::flatten]] Anchor anchorOf(const RigidBody& a, const RigidBody& b, const ContactPoint& c) {
  Anchor anchor;
  anchor.pa_B = toBody(a.pose(), centreOf(c.pa, c.rimA, c.ea, -c.n, c.crosses));
  anchor.pb_B = toBody(b.pose(), centreOf(c.pb, c.rimB, c.eb, c.n, c.crosses));
  const Quat& tied = c.tie == NormalTie::FaceOfA ? a.q : b.q;
  anchor.n_B = tied.conjugate() * c.n;
  if (!c.ea.isZero(0.0)) anchor.ea_B = a.q.conjugate() * c.ea;
  if (!c.eb.isZero(0.0)) anchor.eb_B = b.q.conjugate() * c.eb;
  if (!isSlant(c)) return anchor;
  if (c.rimA > 0.0) anchor.ea_B = a.q.conjugate() * c.ea.cross(crossingAlongA(c));
  if (c.rimB > 0.0) anchor.eb_B = b.q.conjugate() * c.eb.cross(crossingAlongB(c));
  anchor.place_B = toBody(b.pose(), c.pb);
  return anchor;
}

namespace {

/// Of the size of what is round: points that turned to where they are so much nearer went astray.
constexpr double kNearer = 1e-6;

/// [m] of what is round at a contact.
double sizeOf(const ContactPoint& c) {
  return c.halfA.maxCoeff() + c.halfB.maxCoeff() + c.rimA + c.rimB;
}

/// Of rounds that nothing but n tells where they touch, the right n of all parts them most. The
/// torus that stands for an ellipsoid is another one at each n. Newton's method on tori and rims
/// finds it, from the better of the last n and of the first, which went with b; where that leads
/// astray, n goes uphill first.
void followRound(const RigidBody& a, const RigidBody& b, Contact& contact) {
  constexpr int kMostRounds = 60, kMostHalves = 12;
  constexpr double kSettled = 1e-15, kRounding = 1e-12;  // [1]
  constexpr double kStride = 0.5;                        // [1]
  ContactPoint& c = contact.point;
  const Anchor& anchor = contact.anchor;
  const bool onA = c.tie == NormalTie::FaceOfA, onB = c.tie == NormalTie::FaceOfB;
  const double allowed = kNearer * sizeOf(c);
  const Vec3 anchorA = toWorld(a.pose(), anchor.pa_B), anchorB = toWorld(b.pose(), anchor.pb_B);
  Vec3 way;  // [m] from b to a, between what is outermost along n
  const auto bend = [&](const Vec3& n) {
    c.n = n;
    c.pa = anchorA;
    c.pb = anchorB;
    c.ea = a.q * anchor.ea_B;
    c.eb = b.q * anchor.eb_B;
    if (c.tie == NormalTie::EdgeOfA) c.n = across(n, c.ea).normalized();
    if (c.tie == NormalTie::EdgeOfB) c.n = across(n, c.eb).normalized();
    if (c.halfA.x() > 0.0) bendAsEllipsoidA(c, a.x, a.R);
    if (c.halfB.x() > 0.0) bendAsEllipsoidB(c, b.x, b.R);
    way = c.pa - c.pb - (c.ra + c.rb) * c.n;
    if (c.rimA > 0.0) way += c.rimA * rimOfA(c).out;
    if (c.rimB > 0.0) way -= c.rimB * rimOfB(c).out;
    return c.n.dot(way);
  };
  const Vec3 kept = c.n;
  double apart = bend((onA ? a.q : b.q) * anchor.n_B);
  if (!onA && !onB) {
    const Vec3 first = c.n;
    const double then = bend(kept);
    if (!(then > apart)) bend(first);
    apart = std::max(apart, then);
  }
  double turn = std::numeric_limits<double>::infinity();
  for (int round = 0; !onA && !onB && round < kMostRounds; ++round) {
    const Vec3 before = c.n, uphill = across(way, before);
    const bool aligned = alignNormal(c, Vec3(c.pa), Vec3(c.pb));
    const double last = std::exchange(turn, (c.n - before).norm());
    double now = bend(Vec3(c.n));
    if (aligned && (turn <= kSettled || (turn >= last && turn < kRounding))) break;
    if (!aligned || now < apart - allowed) {
      double stride = uphill.isZero(0.0) ? 0.0 : kStride / uphill.norm();
      for (int half = 0; half < kMostHalves; ++half, stride *= 0.5)
        if (now = bend((before + stride * uphill).normalized()); now > apart) break;
      if (!(now > apart)) break;
    }
    apart = now;
  }
  if (c.rimA > 0.0) c.pa += c.rimA * rimOfA(c).out;
  if (c.rimB > 0.0) c.pb += c.rimB * rimOfB(c).out;
  c.separation = c.n.dot(c.pa - c.pb) - c.ra - c.rb;
  if (onA || c.tie == NormalTie::EdgeOfA) c.pa = c.pb + reach(c) * c.n;
  if (onB || c.tie == NormalTie::EdgeOfB) c.pb = c.pa - reach(c) * c.n;
  placeBetween(c);
}

/// Edges and rims that cross at a slant, from where rims are nearest to a place that goes with b.
void followSlant(const RigidBody& a, const RigidBody& b, Contact& contact) {
  ContactPoint& c = contact.point;
  const Anchor& anchor = contact.anchor;
  const Vec3 fromA = toWorld(a.pose(), anchor.pa_B), fromB = toWorld(b.pose(), anchor.pb_B);
  const Vec3 alongA = a.q * anchor.ea_B, alongB = b.q * anchor.eb_B;  // of rims their axes
  const Vec3 place = toWorld(b.pose(), anchor.place_B);
  c.n = b.q * anchor.n_B;
  if (c.rimA > 0.0) c.ea = across(place - fromA, alongA).normalized();
  if (c.rimB > 0.0) c.eb = across(place - fromB, alongB).normalized();
  alignSlant(c, fromA, fromB, alongA, alongB);
  placeBetween(c);
}

/// Whether a rim touches a ball, to whose centre the nearest point of a circle is known.
bool isNearBall(const ContactPoint& c) {
  return c.tie == NormalTie::Points && (c.rimA == 0.0 || c.rimB == 0.0) && c.ra + c.rb > 0.0;
}

/// @param c  with pa and pb at the centres of ball and rim
void followBall(ContactPoint& c) {
  if (c.rimA > 0.0) c.pa += c.rimA * across(c.pb - c.pa, c.ea).normalized();
  if (c.rimB > 0.0) c.pb += c.rimB * across(c.pa - c.pb, c.eb).normalized();
  alongOffset(c, c.pa - c.pb);
  placeBetween(c);
}

}  // namespace

[[gnu::flatten]] void follow(const RigidBody& a, const RigidBody& b, Contact& contact) {
  ContactPoint& c = contact.point;
  if (c.halfA.x() > 0.0 || c.halfB.x() > 0.0) return followRound(a, b, contact);
  if (isSlant(c)) return followSlant(a, b, contact);
  const Anchor& anchor = contact.anchor;
  c.pa = toWorld(a.pose(), anchor.pa_B);
  c.pb = toWorld(b.pose(), anchor.pb_B);
  c.ea = a.q * anchor.ea_B;
  c.eb = b.q * anchor.eb_B;
  const bool rim = hasRim(c);
  if (rim && isNearBall(c)) return followBall(c);
  if (rim && c.tie != NormalTie::FaceOfA && c.tie != NormalTie::FaceOfB) {
    c.n = b.q * anchor.n_B;
    alignNormal(c, Vec3(c.pa), Vec3(c.pb));
    const bool onEdge = c.tie == NormalTie::EdgeOfA || c.tie == NormalTie::EdgeOfB;
    if (onEdge && c.separation < -kNearer * sizeOf(c)) {
      const ContactPoint astray = c;
      followRound(a, b, contact);
      if (std::abs(c.separation) < std::abs(astray.separation)) return;
      c = astray;
    }
    return placeBetween(c);
  }
  switch (tieOf(c)) {
    case NormalTie::FaceOfB:  // the foot of pa moves over the face of b
      c.n = b.q * anchor.n_B;
      placeOnFace(c);
      c.separation = c.n.dot(c.pa - c.pb) - c.ra - c.rb;
      c.pb = c.pa - reach(c) * c.n;
      break;
    case NormalTie::FaceOfA:
      c.n = a.q * anchor.n_B;
      placeOnFace(c);
      c.separation = c.n.dot(c.pa - c.pb) - c.ra - c.rb;
      c.pa = c.pb + reach(c) * c.n;
      break;
    case NormalTie::Points:
      alongOffset(c, c.pa - c.pb);
      break;
    case NormalTie::EdgeOfB:  // the foot of pa moves along the edge of b
      alongOffset(c, across(c.pa - c.pb, c.eb));
      c.pb = c.pa - reach(c) * c.n;
      break;
    case NormalTie::EdgeOfA:
      alongOffset(c, across(c.pa - c.pb, c.ea));
      c.pa = c.pb + reach(c) * c.n;
      break;
    case NormalTie::Edges: {
      // Round edges lie apart, which tells the sign of n; sharp ones keep it.
      nearestOnEdges(c);
      const Vec3 turned = c.ea.cross(c.eb).normalized();
      const Vec3 out = c.ra + c.rb > 0.0 ? Vec3(c.pa - c.pb) : c.n;
      c.n = turned.dot(out) < 0.0 ? Vec3(-turned) : turned;
      c.separation = c.n.dot(c.pa - c.pb) - c.ra - c.rb;
      break;
    }
  }
  placeBetween(c);
}

Vec3 normalRate(const RigidBody& a, const RigidBody& b, const ContactPoint& c) {
  const NormalTie tie = tieOf(c);
  if (tie == NormalTie::FaceOfB) return b.omega.cross(c.n);
  if (tie == NormalTie::FaceOfA) return a.omega.cross(c.n);
  if (hasRim(c)) return rollingOf(a, b, c).rate;
  const Vec3 offsetRate = pointVelocity(a, c.pa) - pointVelocity(b, c.pb);
  const double d = reach(c);
  switch (tie) {
    case NormalTie::Points:
      return across(offsetRate, c.n) / d;
    case NormalTie::EdgeOfB: {  // only the part across the edge turns n; the edge turns with b
      const Vec3 edgeRate = b.omega.cross(c.eb);
      const Vec3 rate = across(offsetRate, c.eb) - d * c.n.dot(edgeRate) * c.eb;
      return across(rate, c.n) / d;
    }
    case NormalTie::EdgeOfA: {
      const Vec3 edgeRate = a.omega.cross(c.ea);
      const Vec3 rate = across(offsetRate, c.ea) - d * c.n.dot(edgeRate) * c.ea;
      return across(rate, c.n) / d;
    }
    default: {  // n = ± ea×eb / |ea×eb|
      const Vec3 product = c.ea.cross(c.eb);
      const Vec3 rate = a.omega.cross(c.ea).cross(c.eb) + c.ea.cross(b.omega.cross(c.eb));
      const double signedLength = product.dot(c.n);
      return across(rate, c.n) / signedLength;
    }
  }
}

Vec3 placeVelocity(const RigidBody& a, const RigidBody& b, const ContactPoint& c) {
  if (rolls(c)) {
    const Rolling roll = rollingOf(a, b, c);
    return pointVelocity(a, c.pa) + roll.wanderA - c.ra * roll.rate;
  }
  switch (c.crosses ? NormalTie::Edges : tieOf(c)) {
    case NormalTie::FaceOfB:
    case NormalTie::Points:
    case NormalTie::EdgeOfB:
      return pointVelocity(a, c.pa) - c.ra * normalRate(a, b, c);
    case NormalTie::FaceOfA:
    case NormalTie::EdgeOfA:
      return pointVelocity(b, c.pb) + c.rb * normalRate(a, b, c);
    default: {  // the nearest points of two edges slide along both: their offset stays along n
      const Vec3 va = pointVelocity(a, c.pa), vb = pointVelocity(b, c.pb);
      const Vec3 ea = c.crosses ? crossingAlongA(c) : c.ea,
                 eb = c.crosses ? crossingAlongB(c) : c.eb;
      const Vec3 side = eb.cross(c.n), rate = normalRate(a, b, c);
      const Vec3 apart = va - vb - reach(c) * rate;
      return va - (apart.dot(side) / ea.dot(side)) * ea - c.ra * rate;
    }
  }
}

double runsRound(const RigidBody& a, const RigidBody& b, const ContactPoint& c) {
  if (c.crosses) return 0.0;
  const Vec3 w = a.omega - b.omega;
  const auto goesRound = [&](const Vec3& u) {
    const double along = u.dot(c.n), turn = c.n.dot(w) - u.dot(w) * along;
    return turn == 0.0 ? 0.0 : std::abs(turn) / (1.0 - along * along);
  };
  const bool roundA = c.rimA > 0.0 && c.halfA.x() == 0.0,
             roundB = c.rimB > 0.0 && c.halfB.x() == 0.0;
  return std::max(roundA ? goesRound(c.ea) : 0.0, roundB ? goesRound(c.eb) : 0.0);
}

double normalAccelerationBias(const RigidBody& a, const RigidBody& b, const ContactPoint& c) {
  const Vec3 centripetal =
      a.omega.cross(a.omega.cross(c.pa - a.x)) - b.omega.cross(b.omega.cross(c.pb - b.x));
  const Vec3 relative = pointVelocity(a, c.pa) - pointVelocity(b, c.pb);
  if (rolls(c)) {
    const Rolling roll = rollingOf(a, b, c);
    const Vec3 wanders = a.omega.cross(roll.wanderA) - b.omega.cross(roll.wanderB);
    return c.n.dot(centripetal + wanders) + roll.rate.dot(relative);
  }
  const Vec3 rate = normalRate(a, b, c);
  double bias = c.n.dot(centripetal) + 2.0 * rate.dot(relative) - reach(c) * rate.squaredNorm();
  if (c.crosses) {  // of a place that went round with n alone, the edge would carry no more
    const Vec3 material = c.tie == NormalTie::FaceOfB
                              ? Vec3(pointVelocity(a, c.pa) - c.ra * rate)
                              : Vec3(pointVelocity(b, c.pb) + (reach(c) - c.ra) * rate);
    bias += 2.0 * c.n.dot((a.omega - b.omega).cross(placeVelocity(a, b, c) - material));
  }
  return bias;
}

Vec3 pointAcceleration(const RigidBody& body, const Vec3& p) {
  if (body.fixed()) return Vec3::Zero();
  const Vec3 alpha = body.Iinv * (body.torque - body.omega.cross(body.L));
  return body.invM * body.force + alpha.cross(p - body.x);
}

double normalAcceleration(const RigidBody& a, const RigidBody& b, const ContactPoint& c) {
  return c.n.dot(pointAcceleration(a, c.p) - pointAcceleration(b, c.p)) +
         normalAccelerationBias(a, b, c);
}

double slipAccelerationBias(const RigidBody& a, const RigidBody& b, const ContactPoint& c,
                            const Vec3& t) {
  const Vec3 place = placeVelocity(a, b, c);
  return t.dot(a.omega.cross(place - a.v) - b.omega.cross(place - b.v));
}

Vec3 slipAcceleration(const RigidBody& a, const RigidBody& b, const ContactPoint& c) {
  const Vec3 pull = pointAcceleration(a, c.p) - pointAcceleration(b, c.p);
  Vec3 t1, t2, rate = Vec3::Zero();
  tangents(c.n, Vec3::Zero(), t1, t2);
  for (const Vec3& t : {t1, t2}) rate += (t.dot(pull) + slipAccelerationBias(a, b, c, t)) * t;
  return rate;
}

[[gnu::flatten]] void tangents(const Vec3& n, const Vec3& preferred, Vec3& t1, Vec3& t2) {
  t1 = across(preferred, n);
  const double length = t1.norm();
  constexpr double kAlong = 1e-9;        // sine to the normal
  constexpr double kVanishing = 1e-150;  // squares of less underflow
  if (length > kAlong * preferred.norm() && length > kVanishing) {
    t1 /= length;
  } else {  // the coordinate axis that is least along n
    int axis = 0;
    n.cwiseAbs().minCoeff(&axis);
    t1 = across(Vec3::Unit(axis), n).normalized();
  }
  t2 = n.cross(t1);
}

}  // namespace tumble
