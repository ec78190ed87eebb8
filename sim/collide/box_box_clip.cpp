// Chapter 5, collide: the region that two faces share when seen along the contact normal.
#include <algorithm>
#include <cmath>

#include "sim/collide/box_box.h"
#include "sim/collide/features.h"

namespace tumble::box_box {

namespace {

// Faces within this of being equally square to n are taken in the order of their axes.
constexpr double kSquareBias = 1e-9;

struct Face {
  int axis;
  bool positive;
};

// The face of a box, axes given as columns of `axes`, whose outward normal is nearest to ±n.
Face supportingFace(const Vec3& along) {
  int best = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(along[k]) > std::abs(along[best]) + kSquareBias) best = k;
  }
  return {best, along[best] > 0.0};
}

// A corner of a polygon that lies on a's face, seen along n on b's face.
struct Corner {
  double u, v;            // [m] along the two axes of b's face
  double separation;      // [m] from b's face along n
  std::uint64_t feature;  // features of a and b that make this corner
  std::uint32_t edge;     // edge of a along which the polygon leaves; kAlongSide on a side of b
};

constexpr std::uint32_t kAlongSide = 0;

struct Polygon {
  Corner corners[kMaxPoints];
  int count = 0;
  void push(const Corner& c) {
    if (count < kMaxPoints) corners[count++] = c;
  }
};

// b's face as a frame to look from.
struct View {
  Vec3 n;
  Face faceA, faceB;
  int u, v;    // axes of b that span its face
  Vec3 halfB;  // [m]

  Corner see(const Vec3& p) const {
    const int k = faceB.axis;
    const double side = faceB.positive ? 1.0 : -1.0;
    const double separation = (side * p[k] - halfB[k]) / (side * n[k]);
    return {p[u] - separation * n[u], p[v] - separation * n[v], separation, 0, 0};
  }
};

// The face of a, its corners in cyclic order.
Polygon faceOfA(const BoxPair& pair, const View& view) {
  const int k = view.faceA.axis, u = nextAxis(k), v = lastAxis(k);
  const bool up = view.faceA.positive;
  Polygon polygon;
  for (int corner = 0; corner < 4; ++corner) {
    const bool onU = corner == 0 || corner == 3, onV = corner < 2;
    bool side[3];
    side[k] = up, side[u] = onU, side[v] = onV;
    Vec3 p_A;
    for (int m = 0; m < 3; ++m) p_A[m] = side[m] ? pair.halfA[m] : -pair.halfA[m];
    Corner c = view.see(pair.d + pair.C * p_A);
    c.feature = featurePair(vertexCode(side[0], side[1], side[2]),
                            faceCode(view.faceB.axis, view.faceB.positive));
    // Corners 0 and 2 leave along u (next axis v, last axis k), the others along v.
    c.edge = corner % 2 == 0 ? edgeCode(u, onV, up) : edgeCode(v, up, onU);
    polygon.push(c);
  }
  return polygon;
}

// What a crossing of the polygon with a side of b's face is called.
std::uint64_t crossingFeature(const View& view, const Corner& x, std::uint32_t edgeOfA,
                              bool acrossU, bool positive) {
  const int k = view.faceB.axis;
  const bool up = view.faceB.positive;
  if (edgeOfA == kAlongSide) {
    bool side[3];
    side[k] = up, side[view.u] = x.u > 0.0, side[view.v] = x.v > 0.0;
    return featurePair(faceCode(view.faceA.axis, view.faceA.positive),
                       vertexCode(side[0], side[1], side[2]));
  }
  const std::uint32_t edgeOfB =
      acrossU ? edgeCode(view.v, up, positive) : edgeCode(view.u, positive, up);
  return featurePair(edgeOfA, edgeOfB);
}

// Keeps the part of the polygon with ±u ≤ half (or ±v ≤ half).
Polygon clipSide(const Polygon& in, const View& view, bool acrossU, bool positive,
                 double tolerance) {
  const double half = view.halfB[acrossU ? view.u : view.v];
  const auto beyond = [&](const Corner& c) {
    const double x = acrossU ? c.u : c.v;
    return (positive ? x : -x) - half;
  };
  Polygon out;
  for (int k = 0; k < in.count; ++k) {
    const Corner& here = in.corners[k];
    const Corner& next = in.corners[k + 1 < in.count ? k + 1 : 0];
    const double dHere = beyond(here), dNext = beyond(next);
    const bool hereIn = dHere <= tolerance, nextIn = dNext <= tolerance;
    if (hereIn) out.push(here);
    if (hereIn == nextIn) continue;

    const double t = std::clamp(dHere / (dHere - dNext), 0.0, 1.0);
    Corner x{here.u + t * (next.u - here.u), here.v + t * (next.v - here.v),
             here.separation + t * (next.separation - here.separation), 0,
             hereIn ? kAlongSide : here.edge};
    x.feature = crossingFeature(view, x, here.edge, acrossU, positive);
    out.push(x);
  }
  return out;
}

}  // namespace

void clipFaces(const BoxPair& pair, const Axis& axis, double tolerance, LocalManifold& out) {
  const Vec3 n = direction(pair, axis);
  const Face faceA = supportingFace(-(pair.C.transpose() * n)), faceB = supportingFace(n);
  const View view{n, faceA, faceB, nextAxis(faceB.axis), lastAxis(faceB.axis), pair.halfB};

  Polygon polygon = faceOfA(pair, view);
  for (const bool acrossU : {true, false}) {
    for (const bool positive : {true, false}) {
      polygon = clipSide(polygon, view, acrossU, positive, tolerance);
    }
  }

  out.n = n;
  out.count = polygon.count;
  for (int k = 0; k < polygon.count; ++k) {
    const Corner& c = polygon.corners[k];
    LocalPoint& point = out.points[k];
    point = {Vec3::Zero(), c.separation, c.feature, axis.tie, axis.i, axis.j};
    point.pb[view.u] = c.u;
    point.pb[view.v] = c.v;
    point.pb[faceB.axis] = faceB.positive ? view.halfB[faceB.axis] : -view.halfB[faceB.axis];
  }
}

}  // namespace tumble::box_box
