// Chapter 5, collide: planes between a cylinder and another solid. No list of axes holds the widest
// here, because the normals of a rim fill a surface: candidates are tried, the best is turned until
// it is the widest near it, and then fixed to the features it meets.
#include <cmath>

#include "sim/collide/convex.h"

namespace tumble::convex {
namespace {

constexpr double kRounding = 1e-15;
// Corners within this part of the size of the outermost belong to the feature that is met.
constexpr double kLevel = 1e-6;
// [part of the size] Nearest points this far apart tell their direction to all digits.
constexpr double kClear = 1e-3;
// Overlaps deeper than this part of the size are worth a longer search.
constexpr double kDeep = 1e-2;
// Features must carry a plane at least as wide as the one they straighten, but for this rounding.
constexpr double kStraight = 1e-13;

// What a core shows outermost along n.
struct Shown {
  enum class Kind { Point, Line, Face, Rim } kind = Kind::Point;
  Vec3 p = Vec3::Zero();  // [m] on it; of a cylinder's side on the axis
  Vec3 e = Vec3::Zero();  // [1] along the line, or the rim
  Vec3 normal = Vec3::Zero();
  double round = 0.0;  // [m] about a line
  int number = -1;     // of the vertex, edge or face
};

Shown shownByCylinder(const Core& core, const Vec3& n) {
  const Vec3 u = core.axis(), lean = n - n.dot(u) * u;
  const int cap = n.dot(u) > 0.0 ? 1 : 0;
  Shown shown;
  shown.p = core.points[cap];
  if (lean.norm() < kLevel) {
    shown.kind = Shown::Kind::Face;
    shown.normal = cap == 1 ? u : Vec3(-u);
    shown.number = cap;
  } else if (std::abs(n.dot(u)) < kLevel) {
    shown.kind = Shown::Kind::Line;
    shown.p = core.middle;
    shown.e = u;
    shown.round = core.disc;
    shown.number = 2;
  } else {
    shown.kind = Shown::Kind::Rim;
    shown.p += core.disc * lean.normalized();
    shown.e = u.cross(lean).normalized();
    shown.number = cap;
  }
  return shown;
}

Shown shownBy(const Core& core, const Vec3& n) {
  if (core.isCylinder()) return shownByCylinder(core, n);
  Shown shown;
  shown.number = outermostVertex(core, n);
  shown.p = core.points[shown.number];
  const double level = n.dot(shown.p) - kLevel * core.size;
  int count = 0;
  for (const Vec3& p : core.points) count += n.dot(p) >= level ? 1 : 0;
  if (count < 2) return shown;
  if (count > 2) {
    shown.kind = Shown::Kind::Face;
    shown.number = 0;
    for (int f = 1; f < static_cast<int>(core.normals.size()); ++f)
      if (core.normals[f].dot(n) > core.normals[shown.number].dot(n)) shown.number = f;
    shown.normal = core.normals[shown.number];
    return shown;
  }
  for (int e = 0; e < static_cast<int>(core.edges.size()); ++e) {
    const Polyhedron::Edge& edge = core.edges[e];
    if (n.dot(core.points[edge.from]) < level || n.dot(core.points[edge.to]) < level) continue;
    shown.kind = Shown::Kind::Line;
    shown.number = e;
    shown.e = core.along(edge).normalized();
  }
  return shown;
}

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

// Takes a straightened direction if it is as wide.
bool straighten(const Core& a, const Core& b, const Vec3& direction, NormalTie tie, Plane& plane) {
  const double length = direction.norm();
  if (!(length > kLevel)) return false;
  Vec3 n = direction / length;
  if (n.dot(plane.n) < 0.0) n = -n;
  const double gap = coreGap(a, b, n);
  if (!(gap >= plane.gap - kStraight * (a.size + b.size))) return false;
  plane.gap = gap;
  plane.n = n;
  plane.tie = tie;
  return true;
}

// A point of one solid against a line or a rim of the other.
bool straightenPoint(const Core& a, const Core& b, const Shown& fa, const Shown& fb, Plane& plane) {
  const bool pointOfB = fb.kind == Shown::Kind::Point;
  const Shown &point = pointOfB ? fb : fa, &line = pointOfB ? fa : fb;
  const Core& solid = pointOfB ? a : b;
  if (point.kind != Shown::Kind::Point || line.kind == Shown::Kind::Face) return false;
  Vec3 v = point.p - line.p, e = line.e;
  if (line.kind == Shown::Kind::Rim) {
    const Vec3 u = solid.axis(), cap = solid.points[line.number];
    const Vec3 out = across(point.p - cap, u).normalized();
    v = point.p - (cap + solid.disc * out);
    e = u.cross(out);
  }
  const NormalTie tie = pointOfB ? NormalTie::EdgeOfA : NormalTie::EdgeOfB;
  // Nearer than this, the direction of the point from a rim is rounding.
  const bool far = across(v, e).norm() > kLevel * (a.size + b.size);
  if (!straighten(a, b, far ? Vec3(across(v, e)) : plane.n, tie, plane)) return false;
  (pointOfB ? plane.ea : plane.eb) = e;
  (pointOfB ? plane.ra : plane.rb) = line.round;
  const double reach = plane.gap + line.round;
  plane.pa = pointOfB ? Vec3(point.p + reach * plane.n) : point.p;
  plane.pb = plane.pa - reach * plane.n;
  return true;
}

// Two lines, or rims, that stand in for them by their tangents.
bool straightenLines(const Core& a, const Core& b, const Shown& fa, const Shown& fb, Plane& plane) {
  const bool bothLines = fa.kind == Shown::Kind::Line && fb.kind == Shown::Kind::Line;
  const Vec3 product = fa.e.cross(fb.e);
  const bool parallel = product.norm() < kLevel;
  plane.ra = fa.round;
  plane.rb = fb.round;
  plane.ea = fa.e;
  plane.eb = fb.e;
  plane.pa = fa.p;
  plane.pb = fb.p;
  const double reach = plane.gap + fa.round + fb.round;
  if (parallel) {
    // The middle of what both share.
    const Vec3 along = fb.e;
    if (!straighten(a, b, bothLines ? across(fa.p - fb.p, along) : plane.n, NormalTie::EdgeOfB,
                    plane))
      return false;
    if (bothLines && !a.isCylinder()) plane.pa = a.points[a.edges[fa.number].from];
    plane.pb = plane.pa - reach * plane.n;
    return true;
  }
  if (!straighten(a, b, bothLines ? product : plane.n, NormalTie::Edges, plane)) return false;
  if (bothLines) {
    const double k = fa.e.dot(fb.e), det = 1.0 - k * k;
    const Vec3 d = fa.p - fb.p;
    plane.pa = fa.p + ((k * d.dot(fb.e) - d.dot(fa.e)) / det) * fa.e;
  } else if (fa.kind == Shown::Kind::Line) {  // the rim's point is where they meet
    plane.pa = fb.p + (plane.gap + fa.round + fb.round) * plane.n;
  }
  plane.pb = plane.pa - (plane.gap + fa.round + fb.round) * plane.n;
  return true;
}

// Fixes the plane to the features that it meets.
void fix(const Core& a, const Core& b, Plane& plane) {
  const Shown fa = shownBy(a, -plane.n), fb = shownBy(b, plane.n);
  plane.i = fa.number;
  plane.j = fb.number;
  if (fb.kind == Shown::Kind::Face && straighten(a, b, fb.normal, NormalTie::FaceOfB, plane)) {
    plane.pa = fa.p - fa.round * plane.n;
    plane.pb = plane.pa - plane.gap * plane.n;
    return;
  }
  if (fa.kind == Shown::Kind::Face && straighten(a, b, -fa.normal, NormalTie::FaceOfA, plane)) {
    plane.pb = fb.p + fb.round * plane.n;
    plane.pa = plane.pb + plane.gap * plane.n;
    return;
  }
  if (straightenPoint(a, b, fa, fb, plane)) return;
  const bool pointOrFace = fa.kind == Shown::Kind::Point || fb.kind == Shown::Kind::Point ||
                           fa.kind == Shown::Kind::Face || fb.kind == Shown::Kind::Face;
  if (!pointOrFace && straightenLines(a, b, fa, fb, plane)) return;
  plane.ra = plane.rb = 0.0;
  plane.tie = NormalTie::FaceOfB;
  plane.pa = fa.p - fa.round * plane.n;
  plane.pb = plane.pa - plane.gap * plane.n;
}

}  // namespace

Plane widestPlaneRound(const Core& a, const Core& b) {
  Plane best;
  const gjk::Nearest nearest = search(a, b, Vec3::Zero());
  if (!nearest.inside) offer(a, b, nearest.v, best);
  if (best.gap < kClear * (a.size + b.size)) {
    if (a.isCylinder()) offerAll(a, b, a, b, 1.0, best);
    if (b.isCylinder()) offerAll(a, b, b, a, -1.0, best);
    turnToWidest(a, b, best);
    if (best.gap < -kDeep * (a.size + b.size)) startAround(a, b, best);
  }
  fix(a, b, best);
  return best;
}

}  // namespace tumble::convex
