// Chapter 5, collide: planes between a cylinder or an ellipsoid and another solid. No list of axes
// holds the widest here, because the normals of a rim fill a surface: candidates are tried, the
// best is turned until it is nearly the widest near it, and the features that it meets tell it to
// the last digits.
#include <cmath>

#include "sim/collide/convex.h"

namespace tumble::convex {
namespace {

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
constexpr int kRounds = 3, kMostRounds = 12;

gjk::Nearest search(const Core& a, const Core& b, const Vec3& shift) {
  const auto support = [&](const Vec3& n) {
    gjk::Outermost o;
    o.a = outermost(a, -n, o.ia) + shift;
    o.b = outermost(b, n, o.ib);
    return o;
  };
  const Vec3 start = a.middle + shift - b.middle;
  const double size = a.size + b.size + 1e-3 * start.norm();
  return gjk::nearest(support, start.isZero(0.0) ? Vec3(Vec3::UnitY()) : start, kRounding * size);
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

}  // namespace

Plane widestPlaneRound(const Core& a, const Core& b, double level) {
  Plane best;
  const gjk::Nearest nearest = search(a, b, Vec3::Zero());
  if (!nearest.inside) offer(a, b, nearest.v, best);
  if (best.gap < kClear * (a.size + b.size)) {
    if (a.isCylinder()) offerAll(a, b, a, b, 1.0, best);
    if (b.isCylinder()) offerAll(a, b, b, a, -1.0, best);
    if (a.isEllipsoid()) offerAround(a, b, a, b, 1.0, best);
    if (b.isEllipsoid()) offerAround(a, b, b, a, -1.0, best);
    turnToWidest(a, b, best);
    if (best.gap < -kDeep * (a.size + b.size)) startAround(a, b, best);
  }
  // What the search leaves n off by may hide a feature from it.
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
  if (told) return best;
  best.tie = NormalTie::FaceOfB;
  best.pa = outermost(a, -best.n, best.i);
  best.pb = best.pa - best.gap * best.n;
  return best;
}

}  // namespace tumble::convex
