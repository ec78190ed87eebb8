// Chapter 5, collide: planes between a cylinder or an ellipsoid and another solid. No list of axes
// holds the widest here, because the normals of a rim fill a surface: candidates are tried, the
// best is turned until it is nearly the widest near it, and the features that it meets tell it to
// the last digits; where they meet each other, before anything is turned.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/collide/convex.h"
#include "sim/collide/facet.h"

namespace tumble::convex {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-15;
// [part of the size] Nearest points this far apart tell their direction to all digits.
constexpr double kClear = 1e-3;
// Overlaps deeper than this part of the size are worth a longer search.
constexpr double kDeep = 1e-2;
// [part of the size] Features carry planes at least as wide as the one that showed them, less this.
constexpr double kLost = 1e-9;
// [1] A plane that turns by less shows the same features.
constexpr double kSame = 1e-6;
constexpr double kSettled = 1e-13;  // [1] where an ellipsoid is met
// [part of the size] What is nearer to a solid is on it.
constexpr double kTouch = 1e-13;
constexpr int kRounds = 3, kMostRounds = 12;

gjk::Nearest search(const Core& a, const Core& b, const Vec3& shift, double enough = kInfinity) {
  const auto support = [&](const Vec3& n) {
    gjk::Outermost o;
    o.a = outermost(a, -n, o.ia) + shift;
    o.b = outermost(b, n, o.ib);
    return o;
  };
  const Vec3 start = a.middle + shift - b.middle;
  const double size = a.size + b.size + 1e-3 * start.norm();
  return gjk::nearest(support, start.isZero(0.0) ? Vec3(Vec3::UnitY()) : start, kRounding * size,
                      enough);
}

void offer(const Core& a, const Core& b, const Vec3& direction, Plane& best) {
  const double length = direction.norm();
  if (!(length > 0.0)) return;
  const Vec3 n = direction / length;
  const double gap = coreGap(a, b, n);
  if (gap > best.gap) best.gap = gap, best.n = n;
}

Vec3 across(const Vec3& v, const Vec3& e) {
  return v - v.dot(e) * e;
}

// Directions that caps, faces, sides, edges and vertices suggest; `sign` −1 if `round` is b.
void offerAll(const Core& a, const Core& b, const Core& round, const Core& other, double sign,
              Plane& best) {
  const Vec3 u = round.axis();
  offer(a, b, u, best);
  offer(a, b, -u, best);
  for (const Vec3& normal : other.normals) offer(a, b, -sign * normal, best);
  for (const Polyhedron::Edge& edge : other.edges) {
    const Vec3 n = u.cross(other.along(edge));
    offer(a, b, n, best);
    offer(a, b, -n, best);
  }
  if (other.isCylinder()) {
    const Vec3 n = u.cross(other.axis());
    offer(a, b, n, best);
    offer(a, b, -n, best);
  }
  for (const Vec3& p : other.points) offer(a, b, sign * across(round.middle - p, u), best);
  offer(a, b, sign * across(round.middle - other.middle, u), best);
}

// Directions that faces and points of the other suggest: an ellipsoid is met along the normal of
// its surface scaled to go through the point.
void offerAround(const Core& a, const Core& b, const Core& oval, const Core& other, double sign,
                 Plane& best) {
  const Vec3 inverse = oval.half.cwiseAbs2().cwiseInverse();
  for (const Vec3& normal : other.normals) offer(a, b, -sign * normal, best);
  for (const Vec3& p : other.points) {
    const Vec3 away = oval.middle - p;
    offer(a, b, sign * away, best);
    offer(a, b, sign * (oval.axes * inverse.cwiseProduct(oval.axes.transpose() * away)), best);
  }
  for (int k = 0; k < 3; ++k)
    for (const double side : {-1.0, 1.0}) offer(a, b, side * oval.axes.col(k), best);
}

// Turns n until it is the widest near it: pulled apart along n to a little gap, the solids' nearest
// points lie along the new n. Where the surface is nearly as bent as it is deep, n turns too
// slowly, and longer steps the same way are tried.
void turnToWidest(const Core& a, const Core& b, Plane& best) {
  constexpr int kMostTurns = 24;
  const double size = a.size + b.size;
  int still = 0;
  for (int k = 0; k < kMostTurns && still < 2; ++k) {
    const double clear = still == 0 ? kClear : 50.0 * kClear;
    const double pull = std::max(0.0, clear * size - best.gap);
    const gjk::Nearest nearest = search(a, b, pull * best.n);
    if (nearest.inside) break;
    const double before = best.gap;
    const Vec3 n = best.n, step = nearest.v.normalized() - n;
    for (double stride = 1.0; stride < 1e3; stride *= 2.0) {
      const double widest = best.gap;
      offer(a, b, n + stride * step, best);
      if (!(best.gap > widest)) break;
    }
    still = best.gap > before + kRounding * size ? 0 : still + 1;
  }
}

// Several planes may be the widest near them: looks for more, from all around.
void startAround(const Core& a, const Core& b, Plane& best) {
  for (int k = 0; k < 27; ++k) {
    if (k == 13) continue;
    Plane other;
    offer(a, b, Vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1), other);
    turnToWidest(a, b, other);
    if (other.gap > best.gap) best = other;
  }
}

// The middle of what a core shows outermost along n.
Vec3 middleShown(const Core& core, const Vec3& n) {
  if (core.isCylinder()) {
    const double up = n.dot(core.axis());
    if (across(n, core.axis()).norm() < kSame) return core.points[up > 0.0 ? 1 : 0];
    if (std::abs(up) < kSame) return core.middle + core.disc * across(n, core.axis()).normalized();
  } else if (!core.normals.empty()) {
    const Facet facet = outermostFacet(core, n);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& corner : facet.corners) sum += corner;
    return sum / static_cast<double>(facet.corners.size());
  }
  int corner = -1;
  return outermost(core, n, corner);
}

// Whether solids that overlap by next to nothing, or do not, have a point each that is as far from
// the other's, along n, as the plane is wide. Then no plane is wider: moved apart along n until
// they touch, that pair of points is their nearest.
bool isMet(const Core& a, const Core& b, const Plane& plane) {
  constexpr double kShallow = 1e-6;  // of the size
  if (plane.gap < -kShallow * (a.size + b.size)) return false;
  const Vec3 way = plane.gap * plane.n;
  const auto meetAt = [&](const Vec3& pa) {
    return holds(a, pa, kTouch * a.size) && holds(b, pa - way, kTouch * b.size);
  };
  return meetAt(plane.pa - plane.ra * plane.n) || meetAt(middleShown(a, -plane.n)) ||
         meetAt(middleShown(b, plane.n) + way);
}

// The plane of the features that n shows, and those that it shows. What the search leaves n off by
// may hide a feature from it. @return whether they carry one as wide
bool tell(const Core& a, const Core& b, double level, Plane& best) {
  // A torus bends as an ellipsoid does at one point alone: each round is a step of Newton's method.
  const bool oval = a.isEllipsoid() || b.isEllipsoid();
  const int rounds = oval ? kMostRounds : kRounds;
  const double same = oval ? kSettled : kSame;
  bool told = false, still = false;
  for (int round = 0; round < rounds && !still; ++round) {
    const Plane plane = planeOfFeatures(a, b, best.n, level);
    if (!(plane.gap >= best.gap - kLost * (a.size + b.size))) break;
    told = true;
    still = (plane.n - best.n).squaredNorm() < same * same;
    best = plane;
  }
  return told;
}

// The same where they meet.
bool tellMet(const Core& a, const Core& b, double level, Plane& best) {
  Plane plane = best;
  if (!tell(a, b, level, plane) || !isMet(a, b, plane)) return false;
  best = plane;
  return true;
}

}  // namespace

Plane widestPlaneRound(const Core& a, const Core& b, double level, double enough) {
  const double size = a.size + b.size, apart = enough + kLost * size;
  Plane best;
  const gjk::Nearest nearest = search(a, b, Vec3::Zero(), apart);
  if (nearest.lower > apart) {
    best.gap = nearest.lower;
    return best;
  }
  if (!nearest.inside) offer(a, b, nearest.v, best);
  if (best.gap < kClear * size) {
    if (!nearest.inside && tellMet(a, b, level, best)) return best;
    if (a.isCylinder()) offerAll(a, b, a, b, 1.0, best);
    if (b.isCylinder()) offerAll(a, b, b, a, -1.0, best);
    if (a.isEllipsoid()) offerAround(a, b, a, b, 1.0, best);
    if (b.isEllipsoid()) offerAround(a, b, b, a, -1.0, best);
    if (tellMet(a, b, level, best)) return best;
    turnToWidest(a, b, best);
    if (best.gap < -kDeep * size) startAround(a, b, best);
  }
  if (tell(a, b, level, best)) return best;
  best.tie = NormalTie::FaceOfB;
  best.pa = outermost(a, -best.n, best.i);
  best.pb = best.pa - best.gap * best.n;
  return best;
}

}  // namespace tumble::convex
