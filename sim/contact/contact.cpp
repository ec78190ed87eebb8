#include "sim/contact/contact.h"

#include <algorithm>
#include <cmath>

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

/// Moves `p` to the point of a rim that is outermost along −n: the direction across the axis that
/// leans most, and there the radius of curvature of the solid along the rim's tangent.
///   d = −(n − (n·u) u)/s,   s = |n − (n·u) u|,   p = centre + r d,   ρ = r/s
void outermostOnRim(const RigidBody& body, const Anchor::Rim& rim, const Vec3& n, Vec3& p, Vec3& e,
                    double& bend) {
  const Vec3 u = body.q * rim.axis_B, lean = across(n, u);
  const double s = lean.norm();
  p = toWorld(body.pose(), rim.centre_B) - (rim.r / s) * lean;
  e = u.cross(lean) / s;
  bend = rim.r / s;
}

/// How fast the outermost point of a rim wanders over its solid [m/s].
Vec3 wandering(const RigidBody& round, const RigidBody& flat, const ContactPoint& c, const Vec3& e,
               const Vec3& n) {
  return c.bend * e.dot((round.omega - flat.omega).cross(n)) * e;
}

/// Whether the point of a face's contact is where two edges cross, and wanders along both: marked
/// by a bend below 0.
bool crosses(const ContactPoint& c) {
  return c.bend < 0.0;
}

}  // namespace

ContactTolerance ContactTolerance::forSize(double size) {
  ContactTolerance t;
  const double s = std::max(1.0, size);
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

ContactClass classify(double vrel, double tolerance) {
  if (vrel < -tolerance) return ContactClass::Colliding;
  return vrel > tolerance ? ContactClass::Separating : ContactClass::Resting;
}

[[gnu::flatten]] Anchor anchorOf(const RigidBody& a, const RigidBody& b, const ContactPoint& c) {
  Anchor anchor;
  anchor.pa_B = toBody(a.pose(), c.pa);
  anchor.pb_B = toBody(b.pose(), c.pb);
  const Quat& tied = c.tie == NormalTie::FaceOfA ? a.q : b.q;
  anchor.n_B = tied.conjugate() * c.n;
  if (!c.ea.isZero(0.0)) anchor.ea_B = a.q.conjugate() * c.ea;
  if (!c.eb.isZero(0.0)) anchor.eb_B = b.q.conjugate() * c.eb;
  return anchor;
}

[[gnu::flatten]] void follow(const RigidBody& a, const RigidBody& b, Contact& contact) {
  ContactPoint& c = contact.point;
  const Anchor& anchor = contact.anchor;
  c.pa = toWorld(a.pose(), anchor.pa_B);
  c.pb = toWorld(b.pose(), anchor.pb_B);
  c.ea = a.q * anchor.ea_B;
  c.eb = b.q * anchor.eb_B;
  switch (c.tie) {
    case NormalTie::FaceOfB:  // the foot of pa moves over the face of b
      c.n = b.q * anchor.n_B;
      if (crosses(c)) nearestOnEdges(c);
      if (anchor.rim.r > 0.0) outermostOnRim(a, anchor.rim, c.n, c.pa, c.ea, c.bend);
      c.separation = c.n.dot(c.pa - c.pb) - c.ra - c.rb;
      c.pb = c.pa - reach(c) * c.n;
      break;
    case NormalTie::FaceOfA:
      c.n = a.q * anchor.n_B;
      if (crosses(c)) nearestOnEdges(c);
      if (anchor.rim.r > 0.0) outermostOnRim(b, anchor.rim, -c.n, c.pb, c.eb, c.bend);
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
  if (c.tie == NormalTie::FaceOfB) return b.omega.cross(c.n);
  if (c.tie == NormalTie::FaceOfA) return a.omega.cross(c.n);
  const Vec3 offsetRate = pointVelocity(a, c.pa) - pointVelocity(b, c.pb);
  const double d = reach(c);
  switch (c.tie) {
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
  if (c.bend > 0.0)
    return c.tie == NormalTie::FaceOfB
               ? Vec3(pointVelocity(a, c.pa) + wandering(a, b, c, c.ea, c.n))
               : Vec3(pointVelocity(b, c.pb) + wandering(b, a, c, c.eb, -c.n));
  switch (crosses(c) ? NormalTie::Edges : c.tie) {
    case NormalTie::FaceOfB:
    case NormalTie::Points:
    case NormalTie::EdgeOfB:
      return pointVelocity(a, c.pa) - c.ra * normalRate(a, b, c);
    case NormalTie::FaceOfA:
    case NormalTie::EdgeOfA:
      return pointVelocity(b, c.pb) + c.rb * normalRate(a, b, c);
    default: {  // the nearest points of two edges slide along both: their offset stays along n
      const Vec3 va = pointVelocity(a, c.pa), vb = pointVelocity(b, c.pb);
      const Vec3 side = c.eb.cross(c.n), rate = normalRate(a, b, c);
      const Vec3 apart = va - vb - reach(c) * rate;
      return va - (apart.dot(side) / c.ea.dot(side)) * c.ea - c.ra * rate;
    }
  }
}

double normalAccelerationBias(const RigidBody& a, const RigidBody& b, const ContactPoint& c) {
  const Vec3 rate = normalRate(a, b, c);
  const Vec3 centripetal =
      a.omega.cross(a.omega.cross(c.pa - a.x)) - b.omega.cross(b.omega.cross(c.pb - b.x));
  const Vec3 relative = pointVelocity(a, c.pa) - pointVelocity(b, c.pb);
  double bias = c.n.dot(centripetal) + 2.0 * rate.dot(relative) - reach(c) * rate.squaredNorm();
  if (c.bend > 0.0) {
    const Vec3& e = c.tie == NormalTie::FaceOfB ? c.ea : c.eb;
    const double rolls = e.dot((a.omega - b.omega).cross(c.n));
    bias -= c.bend * rolls * rolls;
  } else if (crosses(c)) {
    const Vec3 material =
        c.tie == NormalTie::FaceOfB ? pointVelocity(a, c.pa) : pointVelocity(b, c.pb);
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
  if (length > 1e-9 * preferred.norm() && length > 0.0) {
    t1 /= length;
  } else {  // the coordinate axis that is least along n
    int axis = 0;
    n.cwiseAbs().minCoeff(&axis);
    t1 = across(Vec3::Unit(axis), n).normalized();
  }
  t2 = n.cross(t1);
}

}  // namespace tumble
