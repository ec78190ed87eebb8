// Chapter 5, collide: planes across the line between nearest points, and the widest plane of all.
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/collide/convex.h"

namespace tumble::convex {
namespace {

// Relative rounding of a distance.
constexpr double kRounding = 1e-15;
// A plane across nearest points must be wider than one of an axis by this part of the size: where
// they are the same, the axis knows what it is fixed to.
constexpr double kWider = 1e-14;
// Below this sine two edges count as parallel for a plane that is fixed to one of them.
constexpr double kParallel = 1e-9;

gjk::Nearest search(const Core& a, const Core& b) {
  const auto support = [&](const Vec3& n) {
    gjk::Outermost o;
    o.a = outermost(a, -n, o.ia);
    o.b = outermost(b, n, o.ib);
    return o;
  };
  const Vec3 start = a.middle - b.middle;
  const double size = a.size + b.size + 1e-3 * start.norm();
  return gjk::nearest(support, start.isZero(0.0) ? Vec3(Vec3::UnitY()) : start, kRounding * size);
}

// The vertices of one solid that carry the nearest point: one is a vertex, two an edge.
struct Carrier {
  int vertex[4], count = 0;
  void add(int v) {
    for (int k = 0; k < count; ++k)
      if (vertex[k] == v) return;
    vertex[count++] = v;
  }
};

int edgeBetween(const Core& core, int p, int q) {
  for (int e = 0; e < static_cast<int>(core.edges.size()); ++e) {
    const Polyhedron::Edge& edge = core.edges[e];
    if ((edge.from == p && edge.to == q) || (edge.from == q && edge.to == p)) return e;
  }
  return -1;
}

Vec3 along(const Core& core, const Carrier& on) {
  return (core.points[on.vertex[1]] - core.points[on.vertex[0]]).normalized();
}

Vec3 across(const Vec3& v, const Vec3& e) {
  return v - v.dot(e) * e;
}

// Names the features and straightens n, along v, to stand square on the edges among them.
void tie(const Core& a, const Carrier& onA, const Core& b, const Carrier& onB, const Vec3& v,
         Plane& plane) {
  plane.n = v;
  if (onA.count == 1) plane.i = onA.vertex[0];
  if (onB.count == 1) plane.j = onB.vertex[0];
  if (onA.count == 2) {
    plane.tie = NormalTie::EdgeOfA;
    plane.i = edgeBetween(a, onA.vertex[0], onA.vertex[1]);
    plane.ea = along(a, onA);
    plane.n = across(plane.n, plane.ea);
  }
  if (onB.count == 2) {
    plane.eb = along(b, onB);
    plane.j = edgeBetween(b, onB.vertex[0], onB.vertex[1]);
    const Vec3 product = plane.ea.cross(plane.eb);
    if (onA.count == 2 && product.norm() > kParallel) {
      plane.tie = NormalTie::Edges;
      plane.n = product.dot(v) < 0.0 ? Vec3(-product) : product;
    } else {
      plane.tie = NormalTie::EdgeOfB;
      plane.n = across(plane.n, plane.eb);
    }
  }
  plane.n.normalize();
}

}  // namespace

Plane nearestPlane(const Core& a, const Core& b) {
  Plane plane;
  const gjk::Nearest nearest = search(a, b);
  if (nearest.inside || nearest.simplex.count == 0) return plane;
  Carrier onA, onB;
  for (int k = 0; k < nearest.simplex.count; ++k) {
    const gjk::Corner& c = nearest.simplex.corner[k];
    onA.add(c.ia);
    onB.add(c.ib);
    plane.pa += c.weight * c.a;
  }
  plane.pb = plane.pa - nearest.v;
  tie(a, onA, b, onB, nearest.v, plane);
  if (!plane.n.allFinite()) return Plane{};
  plane.gap = coreGap(a, b, plane.n);
  return plane;
}

Plane widestPlane(const Core& a, const Core& b, double bias, double enough) {
  if (a.isCylinder() || b.isCylinder() || a.isEllipsoid() || b.isEllipsoid())
    return widestPlaneRound(a, b, bias / std::max(a.size, b.size), enough);
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  Plane axis = widestOfFaces(a, b, bias);
  // Of cores that a face parts, the plane of their distance spares most pairs of edges.
  Plane nearest;
  const bool parted = axis.gap > 0.0;
  if (parted) nearest = nearestPlane(a, b);
  const auto most = [&] { return nearest.gap - kWider * (a.size + b.size + nearest.gap) - bias; };
  const bool known = nearest.gap > kNone;
  widenByEdges(a, b, bias, known ? nearest.n : axis.n, known ? most() : kNone, axis);
  // The difference of two segments is flat: a plane along it parts nothing, and overlaps nothing.
  const bool flat = a.normals.empty() && b.normals.empty();
  if (!parted && (flat || axis.gap > 0.0 || axis.gap == kNone)) nearest = nearestPlane(a, b);
  if (nearest.gap > kNone && axis.gap < most()) return nearest;
  if (axis.gap > kNone) return axis;

  // Cores without a face that meet: any direction square to an edge.
  const Core& one = a.edges.empty() ? b : a;
  if (!one.edges.empty()) axis.n = one.along(one.edges[0]).unitOrthogonal();
  axis.gap = coreGap(a, b, axis.n);
  axis.pa = axis.pb = a.points[0];
  return axis;
}

}  // namespace tumble::convex
