// Chapter 5, collide: the contact points of a cylinder. Caps are disks, the side is a line, rims
// are circles: what two of them share, seen along the normal, ends at corners of either, at points
// of rims, and where boundaries cross.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "sim/collide/align.h"
#include "sim/collide/convex.h"
#include "sim/collide/crossing_point.h"
#include "sim/collide/facet.h"
#include "sim/collide/rim_points.h"

namespace tumble::convex {
namespace {

// Of the tolerance of polyhedra: nothing here is merely flat to rounding.
constexpr double kClose = 1e-3;
// Below this sine two lines do not cross in a point that could be told.
constexpr double kAlongside = 1e-6;
// Below this sine two lines share a part as well as a point.
constexpr double kParallel = 1e-3;

// What a solid shows of itself: a disk, a polygon, a segment or a point.
struct Patch {
  const Core* core = nullptr;
  Vec3 normal = Vec3::Zero();  // [1] outward; zero of a segment or a point
  int cap = -1;                // of a disk
  Facet polygon = {};          // of the others
  double round = 0.0;          // [m] about a segment, beside the core's radius
  std::uint32_t code = 0;

  bool isDisk() const { return cap >= 0; }
  bool isSide() const { return core->isCylinder() && !isDisk(); }
};

Patch capOf(const Core& core, int cap) {
  Patch patch{.core = &core, .normal = cap == 1 ? core.axis() : Vec3(-core.axis()), .cap = cap};
  patch.code = faceCode(cap);
  return patch;
}

Patch polygonOf(const Core& core, const Facet& facet) {
  return {.core = &core, .normal = facet.normal, .polygon = facet, .code = facet.code};
}

// A side that lies is given by its axis, which rolls; one that leans, by its outermost line.
Patch sideOf(const Core& core, const Vec3& n) {
  const bool lies = std::abs(core.axis().dot(n)) < kFlatCap;
  const Vec3 out = outermostOnRim(core.axis(), core.disc, n).out;
  Patch patch{.core = &core, .round = lies ? core.disc : 0.0, .code = edgeCode(2)};
  for (const Vec3& centre : core.points) {
    patch.polygon.corners.push_back(lies ? centre : Vec3(centre + core.disc * out));
    patch.polygon.sideCodes.push_back(edgeCode(2));
  }
  return patch;
}

// What a core shows along n.
Patch patchOf(const Core& core, const Vec3& n) {
  if (!core.isCylinder()) return polygonOf(core, outermostFacet(core, n));
  const double up = core.axis().dot(n);
  return std::abs(up) > kShowsCap ? capOf(core, up > 0.0 ? 1 : 0) : sideOf(core, n);
}

// Face number `face` of a core.
Patch faceOf(const Core& core, int face) {
  return core.isCylinder() ? capOf(core, face)
                           : polygonOf(core, outermostFacet(core, core.normals[face]));
}

const Vec3& placeOf(const Patch& patch) {
  return patch.isDisk() ? patch.core->points[patch.cap] : patch.polygon.corners[0];
}

// Whether a patch with an area has a point above or below p along n, and which.
bool covers(const Patch& patch, const Vec3& n, const Vec3& p, double tolerance, Vec3& on) {
  if (patch.normal.isZero(0.0)) return false;
  on = p + (patch.normal.dot(placeOf(patch) - p) / patch.normal.dot(n)) * n;
  if (patch.isDisk()) return (on - placeOf(patch)).norm() <= patch.core->disc + tolerance;
  const Few<Vec3>& corners = patch.polygon.corners;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 along = corners[k + 1 < corners.size() ? k + 1 : 0] - corners[k];
    if (along.cross(patch.normal).normalized().dot(on - corners[k]) > tolerance) return false;
  }
  return true;
}

// Calls visit(RimSpot) for the corners of a patch, or points of its rim; `n` is outward.
template <class Visit>
void visitOwn(const Patch& patch, const Vec3& n, Visit visit) {
  if (patch.isDisk()) return visitRim(*patch.core, patch.cap, n, visit);
  if (patch.isSide()) {
    for (const int cap : {0, 1}) visitRim(*patch.core, cap, n, visit);
    return;
  }
  for (std::size_t k = 0; k < patch.polygon.corners.size(); ++k)
    visit(RimSpot{patch.polygon.corners[k], patch.polygon.cornerCodes[k], false});
}

// A part of a boundary: a circle or a segment.
struct Curve {
  Vec3 p = Vec3::Zero(), e = Vec3::Zero();  // [m] centre or start; [1] axis or direction
  double rim = 0.0, length = 0.0;           // [m]
  std::uint32_t code = 0, secondCode = 0;   // of the two places where a circle may be crossed
};

Few<Curve> boundaryOf(const Patch& patch) {
  Few<Curve> curves;
  if (patch.isDisk()) {
    const auto cap = static_cast<std::uint32_t>(patch.cap);
    curves.push_back({.p = placeOf(patch),
                      .e = patch.core->axis(),
                      .rim = patch.core->disc,
                      .code = edgeCode(4) + cap,
                      .secondCode = edgeCode(6) + cap});
    return curves;
  }
  const Facet& polygon = patch.polygon;
  const std::size_t count = polygon.corners.size(), sides = count > 2 ? count : count - 1;
  for (std::size_t k = 0; k < sides; ++k) {
    const Vec3 along = polygon.corners[(k + 1) % count] - polygon.corners[k];
    curves.push_back({.p = polygon.corners[k],
                      .e = along.normalized(),
                      .length = along.norm(),
                      .code = polygon.sideCodes[k],
                      .secondCode = polygon.sideCodes[k]});
  }
  return curves;
}

// Where the two circles, or a circle and a line, cross: about, if they lean against n. Places along
// `across` from the middle; NaN if they do not.
struct Crossings {
  Vec3 middle = Vec3::Zero(), across = Vec3::Zero();
};

Crossings crossingsOf(const Curve& a, const Curve& b, const Vec3& n) {
  const auto flat = [&](const Vec3& v) { return Vec3(v - v.dot(n) * n); };
  const Vec3 way = flat(b.p - a.p);
  if (a.rim > 0.0 && b.rim > 0.0) {
    const double d = way.norm(), x = 0.5 * (d * d + a.rim * a.rim - b.rim * b.rim) / d;
    const double half = std::sqrt(a.rim * a.rim - x * x);
    return {a.p + x / d * way, half / d * n.cross(way)};
  }
  const Curve &circle = a.rim > 0.0 ? a : b, &line = a.rim > 0.0 ? b : a;
  const Vec3 e = flat(line.e).normalized(), from = flat(line.p - circle.p);
  const Vec3 foot = from - from.dot(e) * e;
  return {circle.p + foot, std::sqrt(circle.rim * circle.rim - foot.squaredNorm()) * e};
}

// The points where a meets a face of b, outward normal n.
class OnFace {
 public:
  OnFace(const Patch& a, const Patch& b, const Vec3& n, double tolerance, Manifold& out)
      : a_(a), b_(b), n_(n), tolerance_(tolerance), out_(out), first_(out.size()) {}

  void find() {
    Vec3 on;
    visitOwn(a_, -n_, [&](const RimSpot& spot) {
      if (!covers(b_, n_, spot.p, tolerance_, on)) return;
      ContactPoint c = at(spot.p, on, 0.0, featurePair(spot.code, b_.code));
      if (spot.follows) c.rimA = a_.core->disc, c.ea = a_.core->axis();
      put(c);
    });
    const bool flat = a_.normal.cross(n_).norm() < kFlatCap;
    visitOwn(b_, n_, [&](const RimSpot& spot) {
      if (!covers(a_, n_, spot.p, tolerance_, on)) return;
      ContactPoint c = at(on, spot.p, 0.0, featurePair(a_.code, spot.code));
      if (flat) c.tie = NormalTie::FaceOfA;
      put(c);
    });
    for (const Curve& curveA : boundaryOf(a_))
      for (const Curve& curveB : boundaryOf(b_)) cross(curveA, curveB);
  }

 private:
  // A point on a's surface, or axis, above one on b's.
  ContactPoint at(const Vec3& pa, const Vec3& pb, double round, std::uint64_t feature) const {
    ContactPoint c;
    c.n = n_;
    c.ra = a_.core->radius + round;
    c.rb = b_.core->radius;
    c.separation = n_.dot(pa - pb) - c.ra - c.rb;
    c.pa = pa;
    c.pb = pb;
    c.feature = feature;
    return c;
  }

  void cross(const Curve& a, const Curve& b) {
    if (a.rim == 0.0 && b.rim == 0.0) {
      if (a.e.cross(b.e).norm() > kAlongside) crossAt(a, b, a.p, false);
      return;
    }
    const Crossings found = crossingsOf(a, b, n_);
    if (!found.across.allFinite()) return;
    for (const bool second : {false, true})
      crossAt(a, b, found.middle + (second ? -1.0 : 1.0) * found.across, second);
  }

  void crossAt(const Curve& a, const Curve& b, const Vec3& guess, bool second) {
    ContactPoint c =
        at(a.p, b.p, a_.round,
           featurePair(second ? a.secondCode : a.code, second ? b.secondCode : b.code));
    const auto outward = [&](const Curve& curve) {
      const Vec3 way = guess - curve.p;
      return curve.rim > 0.0 ? Vec3((way - way.dot(curve.e) * curve.e).normalized()) : curve.e;
    };
    c.crosses = true;
    c.rimA = a.rim;
    c.rimB = b.rim;
    c.ea = outward(a);
    c.eb = outward(b);
    alignCrossing(c, a.p, b.p);
    const auto holds = [&](const Curve& curve, const Vec3& p) {
      const double along = (p - curve.p).dot(curve.e);
      return curve.rim > 0.0 || (along >= -tolerance_ && along <= curve.length + tolerance_);
    };
    const Vec3 way = c.pa - c.pb;
    if (!((way - way.dot(n_) * n_).norm() <= tolerance_)) return;
    if (!holds(a, c.pa) || !holds(b, c.pb)) return;
    c.separation = n_.dot(way) - c.ra - c.rb;
    put(c);
  }

  // Unless it is there already.
  void put(const ContactPoint& c) {
    const Vec3 p = c.pa - c.ra * n_;
    const bool known = std::any_of(
        out_.begin() + static_cast<std::ptrdiff_t>(first_), out_.end(),
        [&](const ContactPoint& d) { return (d.pa - d.ra * n_ - p).norm() <= tolerance_; });
    if (!known) out_.push_back(c);
  }

  const Patch &a_, &b_;
  Vec3 n_;
  double tolerance_;
  Manifold& out_;
  std::size_t first_;
};

// The ends of a line of a's that lie along one of b's, or of b's along one of a's.
void endsAlong(const Patch& a, const Patch& b, const Plane& plane, double tolerance,
               Manifold& out) {
  const Vec3 e = plane.eb, from = b.polygon.corners[0];
  const double length = (b.polygon.corners[1] - from).dot(e);
  for (std::uint32_t k = 0; k < 2; ++k) {
    const Vec3& p = a.polygon.corners[k];
    const double along = (p - from).dot(e);
    if (along < std::min(0.0, length) - tolerance || along > std::max(0.0, length) + tolerance)
      continue;
    ContactPoint c;
    c.tie = NormalTie::EdgeOfB;
    c.eb = e;
    c.ra = a.core->radius + a.round;
    c.rb = b.core->radius + b.round;
    const Vec3 foot = from + along * e;
    const double d = (p - foot).norm();
    c.n = d > tolerance ? Vec3((p - foot) / d) : plane.n;
    if (c.n.dot(plane.n) < 0.0) c.n = -c.n;
    c.separation = c.n.dot(p - foot) - c.ra - c.rb;
    c.pa = p;
    c.pb = foot;
    c.feature = featurePair(vertexCode(20) + k, b.code);
    out.push_back(c);
  }
}

// A line as a patch: the axis of a cylinder, an edge, the segment of a capsule.
Patch lineOf(const Core& core, int edge) {
  Patch patch{.core = &core, .round = core.disc, .code = edgeCode(edge)};
  const Polyhedron::Edge* e =
      core.isCylinder() ? nullptr : &core.edges[static_cast<std::size_t>(edge)];
  patch.polygon.corners.push_back(core.points[static_cast<std::size_t>(e ? e->from : 0)]);
  patch.polygon.corners.push_back(core.points[static_cast<std::size_t>(e ? e->to : 1)]);
  return patch;
}

void linePoints(const Patch& lineA, const Patch& lineB, const Plane& plane, double tolerance,
                Manifold& out) {
  endsAlong(lineA, lineB, plane, tolerance, out);
  const std::size_t first = out.size();
  Plane turned = plane;
  turned.n = -plane.n;
  turned.eb = plane.ea;
  endsAlong(lineB, lineA, turned, tolerance, out);
  for (std::size_t k = first; k < out.size(); ++k) mirror(out[k]);
}

// The lines that a core shows along n, nearly square to it.
std::vector<Patch> linesAlong(const Core& core, const Vec3& n, double tolerance) {
  std::vector<Patch> lines;
  if (core.isEllipsoid()) return lines;
  if (core.isCylinder()) {
    if (std::abs(core.axis().dot(n)) < kParallel) lines.push_back(lineOf(core, 0));
    return lines;
  }
  int corner = -1;
  const double level = n.dot(outermost(core, n, corner)) - tolerance;
  for (int k = 0; k < static_cast<int>(core.edges.size()); ++k) {
    const auto& edge = core.edges[static_cast<std::size_t>(k)];
    const Vec3 &p = core.points[static_cast<std::size_t>(edge.from)],
               &q = core.points[static_cast<std::size_t>(edge.to)];
    if (std::max(n.dot(p), n.dot(q)) < level) continue;
    if (std::abs(n.dot(q - p)) < kParallel * (q - p).norm()) lines.push_back(lineOf(core, k));
  }
  return lines;
}

}  // namespace

bool lineEnds(const Core& a, const Core& b, const Plane& plane, double tolerance, Manifold& ends) {
  if (plane.tie == NormalTie::Edges && plane.ea.cross(plane.eb).norm() >= kParallel) return false;
  const double close = kClose * tolerance;
  const auto along = [](const Patch& line) {
    return Vec3((line.polygon.corners[1] - line.polygon.corners[0]).normalized());
  };
  const std::vector<Patch> linesA = linesAlong(a, -plane.n, close);
  if (linesA.empty()) return false;
  const std::vector<Patch> linesB = linesAlong(b, plane.n, close);
  const Patch *lineA = nullptr, *lineB = nullptr;
  double least = kParallel;  // sine
  for (const Patch& ofA : linesA) {
    for (const Patch& ofB : linesB) {
      const double sine = along(ofA).cross(along(ofB)).norm();
      if (sine >= least) continue;
      least = sine;
      lineA = &ofA;
      lineB = &ofB;
    }
  }
  if (!lineA) return false;
  Plane both = plane;
  both.ea = along(*lineA);
  both.eb = along(*lineB);
  linePoints(*lineA, *lineB, both, close, ends);
  return ends.size() > 1;
}

namespace {

bool isRound(const Core& core) {
  return core.isCylinder() || (core.points.size() == 2 && core.radius > 0.0);
}

// An end of `of` above its foot on the axis of `other`, which is b if `of` is a; none if it has no
// foot there.
std::optional<ContactPoint> endAbove(const Core& of, int end, const Core& other, bool ofA,
                                     const ContactPoint& nearest) {
  const Vec3 &p = of.points[end], &from = other.points[0], way = other.points[1] - from;
  const double length = way.norm();
  const Vec3 e = way / length;
  const double s = e.dot(p - from);
  if (!(s > 0.0 && s < length)) return std::nullopt;
  ContactPoint c = nearest;
  c.beside = true;
  c.tie = ofA ? NormalTie::EdgeOfB : NormalTie::EdgeOfA;
  c.ea = ofA ? of.axis() : e;
  c.eb = ofA ? e : of.axis();
  (ofA ? c.rimA : c.rimB) = of.disc;
  (ofA ? c.ra : c.rb) = of.radius;
  (ofA ? c.rb : c.ra) = other.radius + other.disc;
  if (!alignNormal(c, ofA ? p : from, ofA ? from : p)) return std::nullopt;
  const std::uint32_t corner =
      of.isCylinder() ? vertexCode(20) + static_cast<std::uint32_t>(end) : vertexCode(end);
  c.feature = ofA ? featurePair(corner, edgeCode(0)) : featurePair(edgeCode(0), corner);
  c.p = c.pb + (c.rb + 0.5 * c.separation) * c.n;
  return c;
}

}  // namespace

void endsBeside(const Core& a, const Core& b, const ContactPoint& nearest, double tolerance,
                double margin, Manifold& out) {
  if (!isRound(a) || !isRound(b)) return;
  const Vec3 way = (a.points[1] - a.points[0]).normalized();
  // Of the two ends on either side of the crossing, before it and behind it, the nearer one.
  std::optional<ContactPoint> ends[2];
  double far[2] = {};  // [m]
  const auto offer = [&](const std::optional<ContactPoint>& c) {
    if (!c) return;
    const double along = way.dot(c->pa - nearest.pa);
    const int side = along > 0.0 ? 1 : 0;
    if (std::abs(along) <= tolerance || (ends[side] && std::abs(along) >= far[side])) return;
    ends[side] = c;
    far[side] = std::abs(along);
  };
  for (const int end : {0, 1}) {
    offer(endAbove(a, end, b, true, nearest));
    offer(endAbove(b, end, a, false, nearest));
  }
  for (const std::optional<ContactPoint>& end : ends)
    if (end && end->separation <= margin) out.push_back(*end);
}

namespace {

// Where one end is nearer by a little, so that the plane tells of that one alone, the other end.
void farEnd(const Core& a, const Core& b, const Plane& plane, double tolerance, double margin,
            Manifold& out) {
  Manifold ends;
  if (!lineEnds(a, b, plane, tolerance, ends)) return;
  const auto far =
      std::max_element(ends.begin(), ends.end(), [&](const ContactPoint& c, const ContactPoint& d) {
        return (c.pa - plane.pa).squaredNorm() < (d.pa - plane.pa).squaredNorm();
      });
  if (far->separation <= margin) out.push_back(*far);
}

}  // namespace

void roundPoints(const Core& a, const Core& b, const Plane& plane, double tolerance, double margin,
                 Manifold& out) {
  const std::size_t first = out.size();
  const double close = kClose * tolerance;
  const bool onLines = plane.tie == NormalTie::Edges || plane.alongside;
  if (plane.tie == NormalTie::FaceOfB && plane.j >= 0)
    OnFace(patchOf(a, -plane.n), faceOf(b, plane.j), plane.n, close, out).find();
  if (plane.tie == NormalTie::FaceOfA && plane.i >= 0) {
    OnFace(patchOf(b, plane.n), faceOf(a, plane.i), -plane.n, close, out).find();
    for (std::size_t k = first; k < out.size(); ++k) mirror(out[k]);
  }
  if (onLines && plane.ea.cross(plane.eb).norm() < kParallel)
    linePoints(lineOf(a, plane.i), lineOf(b, plane.j), plane, close, out);
  const bool none = out.size() == first;
  if (!plane.alongside && (onLines || none)) out.push_back(pointOf(plane, a, b));
  if (none && onLines && plane.rimA + plane.rimB == 0.0)
    endsBeside(a, b, ContactPoint(out.back()), close, margin, out);
  if (none && !onLines) farEnd(a, b, plane, tolerance, margin, out);
  const auto far = [&](const ContactPoint& c) { return !(c.separation <= margin); };
  out.erase(std::remove_if(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(), far),
            out.end());
  if (out.size() > first) return;
  const ContactPoint c = pointOf(plane, a, b);
  if (c.separation <= margin) out.push_back(c);
}

}  // namespace tumble::convex
