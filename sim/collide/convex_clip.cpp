// Chapter 5, collide: where two solids touch, seen along the contact normal.
#include <algorithm>
#include <cmath>

#include "sim/collide/convex.h"
#include "sim/collide/facet.h"

namespace tumble::convex {
namespace {

// A point that is on a facet but for the tolerance is beside it by no more of it, unless the sides
// that meet there hardly part.
constexpr double kBeside = 10.0;

// A corner of what is left of a's facet, seen along n on b's.
struct Corner {
  Vec3 p;                  // [m] on a's facet
  std::uint32_t ofA, ofB;  // features that make it
  std::uint32_t edge;      // of a along which the outline leaves; 0 along a side of b's facet
  int side;                // that side
};

constexpr std::uint32_t kAlongSide = 0;

using Outline = Few<Corner>;

Outline outlineOf(const Facet& a, const Facet& b) {
  Outline outline;
  for (std::size_t k = 0; k < a.corners.size(); ++k)
    outline.push_back({a.corners[k], a.cornerCodes[k], b.code, a.sideCodes[k], -1});
  return outline;
}

// Names the place where the outline, leaving `here`, crosses a side of b's facet.
void nameCrossing(const Facet& a, const Facet& b, int side, const Corner& here, Corner& x) {
  if (here.edge != kAlongSide) {
    x.ofA = here.edge;
    x.ofB = b.sideCodes[side];
    return;
  }
  const int count = static_cast<int>(b.corners.size());
  const int corner = here.side == (side + 1) % count ? here.side : side;
  x.ofA = a.code;
  x.ofB = b.cornerCodes[corner];
}

// Keeps what is on the inner side of the plane through a side of b's facet and along n.
Outline clipSide(const Outline& in, const Facet& a, const Facet& b, int side, const Vec3& n,
                 double tolerance) {
  const int count = static_cast<int>(in.size()), corners = static_cast<int>(b.corners.size());
  const Vec3& q = b.corners[side];
  const Vec3 out = (b.corners[(side + 1) % corners] - q).cross(n).normalized();
  const auto beyond = [&](const Corner& c) { return out.dot(c.p - q); };
  Outline left;
  for (int k = 0; k < count; ++k) {
    const Corner &here = in[k], &next = in[k + 1 < count ? k + 1 : 0];
    const double dHere = beyond(here), dNext = beyond(next);
    const bool hereIn = dHere <= tolerance, nextIn = dNext <= tolerance;
    if (hereIn) left.push_back(here);
    const bool last = count <= 2 && k == count - 1;  // a segment does not run back
    if (hereIn == nextIn || last) continue;
    const double t = std::clamp(dHere / (dHere - dNext), 0.0, 1.0);
    Corner x{here.p + t * (next.p - here.p), 0, 0, hereIn ? kAlongSide : here.edge,
             hereIn ? side : here.side};
    nameCrossing(a, b, side, here, x);
    left.push_back(x);
  }
  return left;
}

struct Placed {
  Vec3 pa;
  double separation;  // [m] of the cores' points along n
  std::uint64_t feature;
};

using PlacedList = Few<Placed>;

void clipOnFace(const Facet& a, const Facet& b, const Vec3& n, double tolerance, PlacedList& out) {
  Outline outline = outlineOf(a, b);
  for (int side = 0; side < static_cast<int>(b.corners.size()); ++side)
    outline = clipSide(outline, a, b, side, n, tolerance);
  const double slope = b.normal.dot(n);
  for (const Corner& c : outline)
    out.push_back({c.p, b.normal.dot(c.p - b.corners[0]) / slope, featurePair(c.ofA, c.ofB)});
}

// The part that two nearly parallel segments share when seen across: its two ends.
void shareOfSegments(const Facet& a, const Facet& b, const Vec3& n, double tolerance,
                     PlacedList& out) {
  constexpr double kParallel = 1e-3;
  if (a.corners.size() != 2 || b.corners.size() != 2) return;
  const Vec3 wayA = a.corners[1] - a.corners[0], wayB = b.corners[1] - b.corners[0];
  const double lengthB = wayB.norm();
  const Vec3 eb = wayB / lengthB;
  if (wayA.cross(eb).norm() > kParallel * wayA.norm()) return;
  const double start = eb.dot(a.corners[0] - b.corners[0]), rate = eb.dot(wayA);
  const auto push = [&](double t, std::uint32_t ofA, std::uint32_t ofB) {
    const Vec3 p = a.corners[0] + t * wayA;
    const double s = std::clamp(start + t * rate, 0.0, lengthB);
    out.push_back({p, n.dot(p - (b.corners[0] + s * eb)), featurePair(ofA, ofB)});
  };
  for (const int k : {0, 1}) {
    const double s = start + k * rate, t = (k * lengthB - start) / rate;
    if (s >= -tolerance && s <= lengthB + tolerance) push(k, a.cornerCodes[k], b.code);
    if (t > 0.0 && t < 1.0) push(t, a.code, b.cornerCodes[k]);
  }
}

// Something round along an edge: the faces beside that end where it crosses the edge, be it by a
// little. @return whether there are such points
bool clipOnEdge(const Core& a, const Core& b, const Plane& plane, double tolerance, double margin,
                Manifold& out) {
  if (plane.tie == NormalTie::FaceOfA || plane.tie == NormalTie::FaceOfB) return false;
  Manifold ends;
  if (!lineEnds(a, b, plane, tolerance, ends)) return false;
  const std::size_t before = out.size();
  for (const ContactPoint& c : ends)
    if (c.separation <= margin) out.push_back(c);
  return out.size() > before;
}

// Leaves one point of each group that lies within the tolerance, the lowest feature first.
void sortAndMerge(PlacedList& points, double tolerance) {
  std::sort(points.begin(), points.end(),
            [](const Placed& p, const Placed& q) { return p.feature < q.feature; });
  std::size_t kept = 0;
  for (const Placed& candidate : PlacedList(points)) {
    const bool isNew = std::none_of(points.begin(), points.begin() + kept, [&](const Placed& p) {
      return (p.pa - candidate.pa).norm() <= tolerance &&
             std::abs(p.separation - candidate.separation) <= tolerance;
    });
    if (isNew) points[kept++] = candidate;
  }
  points.erase(points.begin() + kept, points.end());
}

}  // namespace

void clipFacets(const Core& a, const Core& b, const Plane& plane, double tolerance, double margin,
                Manifold& out) {
  if (a.isEllipsoid() || b.isEllipsoid()) {
    const ContactPoint c = pointOf(plane, a, b);
    if (c.separation <= margin) out.push_back(c);
    return;
  }
  if (a.isCylinder() || b.isCylinder()) return roundPoints(a, b, plane, tolerance, margin, out);
  const double radii = a.radius + b.radius;
  PlacedList points;
  if (plane.tie != NormalTie::Points) {
    const Facet facetA = outermostFacet(a, -plane.n), facetB = outermostFacet(b, plane.n);
    const bool faces = facetA.isPolygon() || facetB.isPolygon();
    if (radii > 0.0 && faces && clipOnEdge(a, b, plane, tolerance, margin, out)) return;
    if (facetB.isPolygon()) {
      clipOnFace(facetA, facetB, plane.n, tolerance, points);
    } else if (facetA.isPolygon()) {
      clipOnFace(facetB, facetA, -plane.n, tolerance, points);
      for (Placed& p : points) {
        p.pa += p.separation * plane.n;
        p.feature = swappedFeature(p.feature);
      }
    } else {
      shareOfSegments(facetA, facetB, plane.n, tolerance, points);
    }
  }
  // No two points of the cores are nearer along n than the plane is wide. What says so is far
  // beyond the end of a facet that is a sliver, seen along n, though on its sides to the tolerance.
  const double least = plane.gap - kBeside * tolerance;
  points.erase(std::remove_if(points.begin(), points.end(),
                              [&](const Placed& p) {
                                return p.separation < least || !(p.separation - radii <= margin);
                              }),
               points.end());
  // What overlaps may do so beside the facets, which are apart where they face each other.
  const ContactPoint deepest = pointOf(plane, a, b);
  const bool overlaps = std::any_of(points.begin(), points.end(),
                                    [&](const Placed& p) { return p.separation <= radii; });
  const bool beside = plane.gap < -tolerance && !overlaps &&
                      (holds(a, deepest.pb, 0.0) || holds(b, deepest.pa, 0.0));
  if ((points.empty() || beside) && deepest.separation <= margin) out.push_back(deepest);
  if (points.empty()) endsBeside(a, b, deepest, tolerance, margin, out);
  sortAndMerge(points, tolerance);
  for (const Placed& p : points) {
    ContactPoint c = deepest;
    c.ra = a.radius;
    c.rb = b.radius;
    c.separation = p.separation - radii;
    c.feature = p.feature;
    c.pa = p.pa;
    c.pb = p.pa - p.separation * plane.n;
    c.p = c.pb + (c.rb + 0.5 * c.separation) * plane.n;
    out.push_back(c);
  }
}

ContactPoint pointOf(const Plane& plane, const Core& a, const Core& b) {
  ContactPoint c;
  c.n = plane.n;
  c.tie = plane.tie;
  c.ea = plane.ea;
  c.eb = plane.eb;
  c.rimA = plane.rimA;
  c.rimB = plane.rimB;
  if (plane.ra > 0.0) c.halfA = a.half;
  if (plane.rb > 0.0) c.halfB = b.half;
  c.ra = a.radius + plane.ra;
  c.rb = b.radius + plane.rb;
  c.separation = plane.gap - a.radius - b.radius;
  const double reach = plane.gap + plane.ra + plane.rb;
  int i = plane.i, j = plane.j;
  c.pa = plane.pa;
  switch (plane.tie) {
    case NormalTie::FaceOfB:
      if (!a.isCylinder() && !a.isEllipsoid()) c.pa = outermost(a, -plane.n, i);
      break;
    case NormalTie::FaceOfA:
      c.pa = plane.pb + reach * plane.n;
      if (!b.isCylinder() && !b.isEllipsoid()) c.pa = outermost(b, plane.n, j) + reach * plane.n;
      break;
    default:
      break;
  }
  c.pb = c.pa - reach * plane.n;
  c.p = c.pb + (c.rb + 0.5 * c.separation) * plane.n;
  const auto code = [](NormalTie faceTie, NormalTie edgeTie, NormalTie tie, int k) {
    if (k < 0) return kKindCode;
    if (tie == faceTie) return convex::faceCode(k);
    return tie == edgeTie || tie == NormalTie::Edges ? convex::edgeCode(k) : convex::vertexCode(k);
  };
  c.feature = featurePair(code(NormalTie::FaceOfA, NormalTie::EdgeOfA, c.tie, i),
                          code(NormalTie::FaceOfB, NormalTie::EdgeOfB, c.tie, j));
  return c;
}

}  // namespace tumble::convex
