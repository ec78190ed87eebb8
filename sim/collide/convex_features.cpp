// Chapter 5, collide: the plane between the features that two solids, one of them a cylinder, show
// each other: closed forms, and Newton's method where a rim is among them.
#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/collide/align.h"
#include "sim/collide/convex.h"
#include "sim/collide/ellipsoid.h"
#include "sim/collide/facet.h"
#include "sim/collide/rim_points.h"

namespace tumble::convex {
namespace {

// [1] Features count as shown along n if they are along a direction this near.
constexpr double kNear = 1e-5;
// [1] Below this sine two lines are parallel.
constexpr double kParallel = 1e-6;
// [1] A cap that leans by less than this has a rim without an outermost point.
constexpr double kLevelRim = 1e-13;
// [part of the size] A plane of later features must be wider than one of earlier ones by this.
constexpr double kWider = 1e-14;
// [m] The gap of no plane is less.
constexpr double kNone = -1e300;

// What a core shows outermost along n.
struct Shown {
  enum class Kind { Face, Line, Rim, Point } kind = Kind::Point;
  Vec3 p = Vec3::Zero();  // [m] on it; of a cylinder's side on the axis, of a rim its centre
  Vec3 e = Vec3::Zero();  // [1] along the line; outward of a face; axis of a rim
  double round = 0.0;     // [m] about a line
  double rim = 0.0;       // [m] radius
  int number = -1;        // of the vertex, edge, face or cap
};

using AllShown = Few<Shown>;
using Kind = Shown::Kind;

void showCylinder(const Core& core, const Vec3& n, AllShown& all) {
  const Vec3& u = core.axis();
  const double up = n.dot(u), lean = leanOf(core, n);
  for (const int cap : {0, 1}) {
    const double way = cap == 1 ? up : -up;
    const Vec3 outward = cap == 1 ? u : Vec3(-u);
    if (way > 0.0 && lean < kNear)
      all.push_back({Kind::Face, core.points[cap], outward, 0, 0, cap});
    if (way > -kNear && lean > kLevelRim)
      all.push_back({Kind::Rim, core.points[cap], u, 0.0, core.disc, rimNumber(cap)});
  }
  if (std::abs(up) < kNear) all.push_back({Kind::Line, core.middle, u, core.disc, 0.0, 2});
}

void showCorners(const Core& core, const Vec3& n, AllShown& all) {
  const int far = outermostVertex(core, n);
  const double level = n.dot(core.points[far]) - kNear * core.size;
  int face = -1;
  for (int f = 0; f < static_cast<int>(core.normals.size()); ++f)
    if (face < 0 || core.normals[f].dot(n) > core.normals[face].dot(n)) face = f;
  if (face >= 0 && core.normals[face].cross(n).norm() < kNear)
    all.push_back({Kind::Face, core.points[core.faces[face][0]], core.normals[face], 0, 0, face});
  for (int e = 0; e < static_cast<int>(core.edges.size()); ++e) {
    const Vec3 &p = core.points[core.edges[e].from], &q = core.points[core.edges[e].to];
    if (n.dot(p) < level || n.dot(q) < level) continue;
    all.push_back({Kind::Line, p, (q - p).normalized(), 0.0, 0.0, e});
  }
  for (int k = 0; k < static_cast<int>(core.points.size()); ++k)
    if (n.dot(core.points[k]) >= level)
      all.push_back({.kind = Kind::Point, .p = core.points[k], .number = k});
}

// The torus that bends as the ellipsoid does where n is its normal.
void showEllipsoid(const Core& core, const Vec3& n, AllShown& all) {
  const Osculating torus = osculatingTorus(core.half, core.axes, n);
  all.push_back({torus.rim > 0.0 ? Kind::Rim : Kind::Point, core.points[0] + torus.centre,
                 torus.axis, torus.round, torus.rim, 0});
}

AllShown shownBy(const Core& core, const Vec3& n) {
  AllShown all;
  if (core.isEllipsoid()) {
    showEllipsoid(core, n, all);
    return all;
  }
  core.isCylinder() ? showCylinder(core, n, all) : showCorners(core, n, all);
  std::stable_sort(all.begin(), all.end(),
                   [](const Shown& p, const Shown& q) { return p.kind < q.kind; });
  return all;
}

// The plane of a face of b, and what of a meets it.
Plane onFace(const Core& a, const Shown& face, bool faceOfB) {
  Plane plane;
  plane.tie = faceOfB ? NormalTie::FaceOfB : NormalTie::FaceOfA;
  plane.n = faceOfB ? face.e : Vec3(-face.e);
  int vertex = -1;
  Vec3 p = outermost(a, -face.e, vertex);
  const double height = face.e.dot(p - face.p);
  (faceOfB ? plane.i : plane.j) = vertex;
  (faceOfB ? plane.j : plane.i) = face.number;
  if (a.isCylinder()) {
    const int cap = a.axis().dot(face.e) < 0.0 ? 1 : 0;
    (faceOfB ? plane.i : plane.j) = rimNumber(cap);
    if (leanOf(a, face.e) >= kFlatCap) {
      (faceOfB ? plane.rimA : plane.rimB) = a.disc;
      (faceOfB ? plane.ea : plane.eb) = a.axis();
    }
  }
  if (a.isEllipsoid()) {
    const Osculating torus = osculatingTorus(a.half, a.axes, -face.e);
    (faceOfB ? plane.i : plane.j) = 0;
    (faceOfB ? plane.ra : plane.rb) = torus.round;
    (faceOfB ? plane.rimA : plane.rimB) = torus.rim;
    (faceOfB ? plane.ea : plane.eb) = torus.axis;
    p += torus.round * face.e;
  }
  const Vec3 foot = p - (height + (faceOfB ? plane.ra : plane.rb)) * face.e;
  plane.pa = faceOfB ? p : foot;
  plane.pb = faceOfB ? foot : p;
  return plane;
}

void lines(const Shown& fa, const Shown& fb, Plane& plane) {
  plane.ea = fa.e;
  plane.eb = fb.e;
  const Vec3 product = fa.e.cross(fb.e);
  plane.alongside = product.norm() < kParallel;
  if (plane.alongside) {
    Vec3 d = fa.p - fb.p;
    d -= d.dot(fb.e) * fb.e;
    plane.tie = NormalTie::EdgeOfB;
    // Edges that are sharp, and meet, tell no direction.
    const Vec3 n = d.norm() > kParallel * (fa.round + fb.round) ? d : plane.n;
    plane.n = (n - n.dot(fb.e) * fb.e).normalized() * (n.dot(plane.n) < 0.0 ? -1.0 : 1.0);
    plane.pa = fa.p;
    return;
  }
  plane.tie = NormalTie::Edges;
  plane.n = product.normalized() * (product.dot(plane.n) < 0.0 ? -1.0 : 1.0);
  cross(fa.p, fa.e, fb.p, fb.e, plane);
}

// Points and rims against each other and against lines: n is free to turn, or about a line.
bool turning(const Shown& fa, const Shown& fb, Plane& plane) {
  ContactPoint c;
  c.n = plane.n;
  c.tie = fa.kind == Kind::Line   ? NormalTie::EdgeOfA
          : fb.kind == Kind::Line ? NormalTie::EdgeOfB
                                  : NormalTie::Points;
  c.ea = fa.e;
  c.eb = fb.e;
  c.rimA = fa.rim;
  c.rimB = fb.rim;
  if (c.rimA + c.rimB > 0.0) {
    if (!alignNormal(c, fa.p, fb.p)) return false;
  } else {
    Vec3 way = fa.p - fb.p;
    const Vec3& e = fa.kind == Kind::Line ? fa.e : fb.e;
    way -= way.dot(e) * e;
    if (!(way.norm() > 0.0)) return false;
    c.n = way.normalized() * (way.dot(c.n) < 0.0 ? -1.0 : 1.0);
    c.pa = fa.p;
    c.pb = fb.p;
  }
  plane.tie = c.tie;
  plane.n = c.n;
  plane.ea = c.ea;
  plane.eb = c.eb;
  plane.rimA = c.rimA;
  plane.rimB = c.rimB;
  plane.pa = c.pa;
  plane.pb = c.pb;
  return plane.n.allFinite();
}

// The plane between two features that are no faces, if there is one.
std::optional<Plane> between(const Shown& fa, const Shown& fb, const Vec3& n) {
  Plane plane;
  plane.n = n;
  if (fa.kind == Kind::Line && fb.kind == Kind::Line)
    lines(fa, fb, plane);
  else if (!turning(fa, fb, plane))
    return std::nullopt;
  plane.i = fa.number;
  plane.j = fb.number;
  plane.ra = fa.round;
  plane.rb = fb.round;
  return plane;
}

/// How far [m] the features of a plane are apart along n.
double apartAlong(const Plane& plane, const Shown& fa, const Shown& fb) {
  const bool lines = fa.kind == Kind::Line && fb.kind == Kind::Line;
  const Vec3 way = lines ? Vec3(fa.p - fb.p) : Vec3(plane.pa - plane.pb);
  return plane.n.dot(way) - plane.ra - plane.rb;
}

}  // namespace

Plane planeOfFeatures(const Core& a, const Core& b, const Vec3& n, double level) {
  const AllShown ofA = shownBy(a, -n), ofB = shownBy(b, n);
  const double wider = kWider * (a.size + b.size);
  Plane best;
  double bestOff = 0.0;
  // Edges that are parallel share a plane, of which the outermost alone meets the other solid: what
  // features are apart, less the gap, is least.
  const auto offer = [&](Plane plane, double apart) {
    plane.gap = coreGap(a, b, plane.n);
    const double off = apart - plane.gap;
    const bool first = !(best.gap > kNone);
    const bool same = !first && std::abs(plane.gap - best.gap) <= wider && off < bestOff - wider;
    if (!same && !(plane.gap > best.gap + (first ? 0.0 : wider))) return;
    best = plane;
    bestOff = off;
    // Feet.
    const double reach = best.gap + best.ra + best.rb;
    if (best.tie == NormalTie::EdgeOfA)
      best.pa = best.pb + reach * best.n;
    else if (best.tie != NormalTie::FaceOfA)
      best.pb = best.pa - reach * best.n;
  };
  // A face tells all, whatever meets it.
  for (const Shown& fb : ofB)
    if (fb.kind == Kind::Face) offer(onFace(a, fb, true), kNone);
  for (const Shown& fa : ofA)
    if (fa.kind == Kind::Face) offer(onFace(b, fa, false), kNone);
  const Plane flat = best;
  for (const Shown& fb : ofB)
    for (const Shown& fa : ofA)
      if (fa.kind != Kind::Face && fb.kind != Kind::Face)
        if (const std::optional<Plane> plane = between(fa, fb, n))
          offer(*plane, apartAlong(*plane, fa, fb));
  const bool lies = flat.gap > kNone && (flat.n - best.n).norm() <= level;
  return lies ? flat : best;
}

}  // namespace tumble::convex
