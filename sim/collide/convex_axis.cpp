// Chapter 5, collide: the separating-axis test of two convex polyhedra, or segments, or points.
#include <cmath>

#include "sim/collide/convex.h"

namespace tumble::convex {
namespace {

// Below this sine two edges are parallel up to rounding: what they could add is sine · size.
constexpr double kParallel = 1e-15;
// Above this one their product is good enough to see that it cannot win.
constexpr double kClearSine = 0.1;

// Across the faces of `solid`: the widest slab between it and the other, and which face.
struct WidestFace {
  double gap = -std::numeric_limits<double>::infinity();
  int face = -1;
};

WidestFace widestFace(const Core& solid, const Core& other) {
  WidestFace widest;
  for (int f = 0; f < static_cast<int>(solid.normals.size()); ++f) {
    const Vec3& n = solid.normals[f];
    const double foot = n.dot(solid.points[solid.faces[f][0]]);
    // Corner by corner, until one is too deep for this face to win.
    double low = std::numeric_limits<double>::infinity();
    for (const Vec3& p : other.points) {
      low = std::min(low, n.dot(p) - foot);
      if (low <= widest.gap) break;
    }
    if (low > widest.gap) widest = {low, f};
  }
  return widest;
}

void tryFaces(const Core& a, const Core& b, double bias, Plane& best) {
  const WidestFace ofB = widestFace(b, a), ofA = widestFace(a, b);
  if (ofA.face >= 0 && ofA.gap > ofB.gap + bias) {
    best.tie = NormalTie::FaceOfA;
    best.i = ofA.face;
    best.n = -a.normals[ofA.face];
  } else if (ofB.face >= 0) {
    best.tie = NormalTie::FaceOfB;
    best.j = ofB.face;
    best.n = b.normals[ofB.face];
  } else {
    return;
  }
  best.gap = coreGap(a, b, best.n);
}

// Nearest points of two lines that are not parallel.
void crossing(const Vec3& a, const Vec3& ea, const Vec3& b, const Vec3& eb, Plane& plane) {
  const Vec3 d = a - b;
  const double k = ea.dot(eb), det = 1.0 - k * k;
  const double da = d.dot(ea), db = d.dot(eb);
  plane.pa = a + ((k * db - da) / det) * ea;
  plane.pb = b + ((db - k * da) / det) * eb;
}

// All edges as unit vectors.
Few<Vec3> directions(const Core& core) {
  Few<Vec3> unit;
  for (const Polyhedron::Edge& e : core.edges) unit.push_back(core.along(e).normalized());
  return unit;
}

// The plane along edges i of a and j of b with directions ea and eb; `up` tells its side.
void tryEdges(const Core& a, int i, const Vec3& ea, const Core& b, int j, const Vec3& eb, double up,
              double bias, Plane& best) {
  const Vec3 product = up * ea.cross(eb);
  const double sine = product.norm();
  if (sine < kParallel) return;
  const double floor = best.gap + (best.tie == NormalTie::Edges ? 0.0 : bias);
  const Vec3 &p = a.points[a.edges[i].from], &q = b.points[b.edges[j].from];
  if (sine > kClearSine && !(product.dot(p - q) > floor * sine)) return;
  // Where the sine is small, the product is off also along the edges; across them it is free.
  Vec3 n = product / sine;
  n = (n - n.dot(ea) * ea).normalized();
  if (!(n.dot(p - q) > floor)) return;
  const double gap = coreGap(a, b, n);
  if (!(gap > floor)) return;
  best.tie = NormalTie::Edges;
  best.i = i;
  best.j = j;
  best.n = n;
  best.gap = gap;
  best.ea = ea;
  best.eb = eb;
  crossing(p, ea, q, eb, best);
}

// What the search over pairs of edges asks of one solid.
struct Edges {
  Few<Vec3> along;
  const Polyhedron::Edge* edges;
  const Vec3* normals;  // none if the solid is a segment
  int count, faces;

  explicit Edges(const Core& core)
      : along(directions(core)),
        edges(core.edges.data()),
        normals(core.normals.data()),
        count(static_cast<int>(core.edges.size())),
        faces(static_cast<int>(core.normals.size())) {}
};

// The edges of b whose arcs of normals cross the great circle that edge `ea` of a stands square on;
// the heights of b's normals over that circle. Written without branches, which would be guessed
// wrong half the time.
int crossingEdges(const Vec3& ea, const Edges& b, double* heights, int* crossing) {
  for (int f = 0; f < b.faces; ++f) heights[f] = b.normals[f].dot(ea);
  int count = 0;
  for (int j = 0; j < b.count; ++j) {
    crossing[count] = j;
    count += b.faces == 0 || heights[b.edges[j].left] * heights[b.edges[j].right] < 0.0 ? 1 : 0;
  }
  return count;
}

// An edge between two faces is an arc of normals; that of a segment is a whole circle. The arc of
// an edge of b and the mirrored arc of one of a cross if each has its ends on two sides of the
// other, and both are on one side of the sphere.
void tryAllEdges(const Core& coreA, const Core& coreB, double bias, Plane& best) {
  const Edges a(coreA), b(coreB);
  Few<double> heights(b.faces);
  Few<int> crossing(b.count + 1);
  for (int i = 0; i < a.count; ++i) {
    const Polyhedron::Edge& edgeA = a.edges[i];
    const Vec3& ea = a.along.data()[i];
    const int found = crossingEdges(ea, b, heights.data(), crossing.data());
    for (int k = 0; k < found; ++k) {
      const int j = crossing.data()[k];
      const Vec3& eb = b.along.data()[j];
      double up = 0.0;  // the side of ea × eb on which both have their normals
      if (a.faces > 0) {
        const double left = a.normals[edgeA.left].dot(eb), right = a.normals[edgeA.right].dot(eb);
        if (!(left * right < 0.0)) continue;
        up = left < 0.0 ? 1.0 : -1.0;
      }
      if (b.faces > 0) {
        const double side = heights.data()[b.edges[j].left] < 0.0 ? 1.0 : -1.0;
        if (a.faces > 0 && side != up) continue;
        up = side;
      }
      if (up == 0.0) tryEdges(coreA, i, ea, coreB, j, eb, -1.0, bias, best);
      tryEdges(coreA, i, ea, coreB, j, eb, up == 0.0 ? 1.0 : up, bias, best);
    }
  }
}

}  // namespace

Plane widestAxis(const Core& a, const Core& b, double bias) {
  Plane best;
  tryFaces(a, b, bias, best);
  tryAllEdges(a, b, bias, best);
  return best;
}

}  // namespace tumble::convex
