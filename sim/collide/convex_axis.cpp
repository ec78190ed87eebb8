// Chapter 5, collide: the separating-axis test of two convex polyhedra, or segments, or points.
#include <algorithm>
#include <cmath>
#include <tuple>

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

// How wide [m] a plane along two edges must be to win, and wider than `least`.
struct ToWin {
  double bias, least;
  double over(const Plane& best) const {
    return std::max(best.gap + (best.tie == NormalTie::Edges ? 0.0 : bias), least);
  }
};

// The plane along edges i of a and j of b with directions ea and eb; `up` tells its side.
void tryEdges(const Core& a, int i, const Vec3& ea, const Core& b, int j, const Vec3& eb, double up,
              const ToWin& toWin, Plane& best) {
  const Vec3 product = up * ea.cross(eb);
  const double sine = product.norm();
  if (sine < kParallel) return;
  const double floor = toWin.over(best);
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
  cross(p, ea, q, eb, best);
}

// Rounding of a point's height over a face, as a share of its distance from a corner of the face.
constexpr double kSlack = 1e-12;

// The edges of a solid across which the gap to another can be above a floor, for the search over
// pairs. Let m be an axis in the arc of normals of an edge, p on the edge, q any point of the other
// solid: the gap along m is at most m·(q − p). That is most where m is along the way from the
// edge's line to q, if it can be, and else at an end of the arc: no more than the higher of the
// heights of q over the two faces. So a q near the contact leaves the edges around it.
struct Edges {
  const Core& core;
  Few<int> number;  // of those edges across which a gap above a floor can be
  Few<Vec3> along;  // their unit vectors
  Few<double> heights;

  Edges(const Core& solid, const Vec3& other, double floor) : core(solid) {
    const double slack = kSlack * ((other - solid.middle).norm() + 2.0 * solid.size);
    for (std::size_t f = 0; f < solid.normals.size(); ++f)
      heights.push_back(solid.normals[f].dot(other - solid.points[solid.faces[f][0]]));
    for (int i = 0; i < static_cast<int>(solid.edges.size()); ++i) {
      const Polyhedron::Edge& edge = solid.edges[i];
      if (!isSegment() && std::max(heights[edge.left], heights[edge.right]) <= floor - slack &&
          (floor <= 0.0 || !isBetween(edge, slack)))
        continue;
      number.push_back(i);
      along.push_back(solid.along(edge).normalized());
    }
  }
  // Whether the way from the edge's line to a point at these heights lies between its normals.
  bool isBetween(const Polyhedron::Edge& edge, double slack) const {
    const double left = heights[edge.left], right = heights[edge.right];
    const double cosine = core.normals[edge.left].dot(core.normals[edge.right]);
    return left - cosine * right >= -slack && right - cosine * left >= -slack;
  }
  bool isSegment() const { return core.normals.empty(); }
  const Polyhedron::Edge& edge(int k) const { return core.edges[number[k]]; }
  int count() const { return static_cast<int>(number.size()); }
};

// The edges of b whose arcs of normals cross the great circle that edge `ea` of a stands square on;
// the heights of b's normals over that circle. Written without branches, which would be guessed
// wrong half the time.
int crossingEdges(const Vec3& ea, Edges& b, int* crossing) {
  const bool segment = b.isSegment();
  double* const heights = b.heights.data();
  for (std::size_t f = 0; f < b.heights.size(); ++f) heights[f] = b.core.normals[f].dot(ea);
  int count = 0;
  for (int k = 0; k < b.count(); ++k) {
    crossing[count] = k;
    count += segment || heights[b.edge(k).left] * heights[b.edge(k).right] < 0.0 ? 1 : 0;
  }
  return count;
}

// Calls visit(edge of a, its unit vector, edge of b, its, side) for the pairs that are left. An
// edge between two faces is an arc of normals; that of a segment is a whole circle. The arc of an
// edge of b and the mirrored arc of one of a cross if each has its ends on two sides of the other,
// and both are on one side of the sphere.
template <class Visit>
void forCrossingEdges(Edges& a, Edges& b, const Visit& visit) {
  Few<int> crossing(b.number.size() + 1);
  for (int i = 0; i < a.count(); ++i) {
    const Vec3& ea = a.along[i];
    const int found = crossingEdges(ea, b, crossing.data());
    for (int k = 0; k < found; ++k) {
      const int j = crossing[k];
      const Vec3& eb = b.along[j];
      double up = 0.0;  // the side of ea × eb on which both have their normals
      if (!a.isSegment()) {
        const double left = a.core.normals[a.edge(i).left].dot(eb);
        const double right = a.core.normals[a.edge(i).right].dot(eb);
        if (!(left * right < 0.0)) continue;
        up = left < 0.0 ? 1.0 : -1.0;
      }
      if (!b.isSegment()) {
        const double side = b.heights[b.edge(j).left] < 0.0 ? 1.0 : -1.0;
        if (!a.isSegment() && side != up) continue;
        up = side;
      }
      if (up == 0.0) visit(a.number[i], ea, b.number[j], eb, -1.0);
      visit(a.number[i], ea, b.number[j], eb, up == 0.0 ? 1.0 : up);
    }
  }
}

}  // namespace

void cross(const Vec3& p, const Vec3& ea, const Vec3& q, const Vec3& eb, Plane& plane) {
  const Vec3 d = q - p, product = ea.cross(eb);
  const double squared = product.squaredNorm();
  plane.pa = p + (d.cross(eb).dot(product) / squared) * ea;
  plane.pb = q + (d.cross(ea).dot(product) / squared) * eb;
}

Plane widestOfFaces(const Core& a, const Core& b, double bias) {
  Plane best;
  tryFaces(a, b, bias, best);
  return best;
}

void widenByEdges(const Core& coreA, const Core& coreB, double bias, const Vec3& n, double least,
                  Plane& best) {
  int vertex = -1;
  const ToWin toWin{bias, least};
  const double floor = toWin.over(best);
  Edges a(coreA, outermost(coreB, n, vertex), floor);
  Edges b(coreB, outermost(coreA, -n, vertex), floor);
  forCrossingEdges(a, b, [&](int i, const Vec3& ea, int j, const Vec3& eb, double up) {
    tryEdges(coreA, i, ea, coreB, j, eb, up, toWin, best);
  });
}

void allAxes(const Core& a, const Core& b, std::vector<Plane>& planes) {
  planes.clear();
  const auto offerFace = [&](NormalTie tie, int face, const Vec3& n) {
    Plane& plane = planes.emplace_back();
    plane.tie = tie;
    (tie == NormalTie::FaceOfA ? plane.i : plane.j) = face;
    plane.n = n;
    plane.gap = coreGap(a, b, n);
  };
  for (int f = 0; f < static_cast<int>(b.normals.size()); ++f)
    offerFace(NormalTie::FaceOfB, f, b.normals[f]);
  for (int f = 0; f < static_cast<int>(a.normals.size()); ++f)
    offerFace(NormalTie::FaceOfA, f, -a.normals[f]);
  const double none = -std::numeric_limits<double>::infinity();
  Edges ofA(a, b.middle, none), ofB(b, a.middle, none);
  forCrossingEdges(ofA, ofB, [&](int i, const Vec3& ea, int j, const Vec3& eb, double up) {
    Plane plane;
    tryEdges(a, i, ea, b, j, eb, up, {0.0, none}, plane);
    if (plane.gap > none) planes.push_back(plane);
  });
  std::sort(planes.begin(), planes.end(), [](const Plane& p, const Plane& q) {
    return std::tuple(-p.gap, p.tie, p.i, p.j) < std::tuple(-q.gap, q.tie, q.i, q.j);
  });
}

}  // namespace tumble::convex
