// Chapter 5, collide: the nearest features of two boxes, by trying all pairs. Needed rarely: only
// where the boxes are apart and the nearest features do not lie in the two supporting faces.
#include <cmath>

#include "sim/collide/box_box.h"
#include "sim/collide/features.h"

namespace tumble::box_box {

namespace {

Vec3 vertex(const Vec3& half, unsigned code) {
  return {code & 1 ? half.x() : -half.x(), code & 2 ? half.y() : -half.y(),
          code & 4 ? half.z() : -half.z()};
}

// Collects the pairs of points of least distance; `n` belongs to the first of them.
class Least {
 public:
  Least(double tolerance, LocalManifold& out) : tolerance_(tolerance), out_(out) {}

  void offer(const LocalPoint& point, const Vec3& n) {
    if (out_.count > 0 && point.separation > out_.points[0].separation + tolerance_) return;
    if (out_.count == 0 || point.separation < out_.points[0].separation - tolerance_) {
      out_.count = 0;
      out_.n = n;
    }
    constexpr double kOther = 1e-9;  // of unit normals
    if (out_.count == kMaxPoints || (n - out_.n).norm() > kOther) return;
    out_.points[out_.count++] = point;
  }

 private:
  double tolerance_;
  LocalManifold& out_;
};

void offerVerticesOfA(const BoxPair& p, Least& least) {
  for (unsigned v = 0; v < 8; ++v) {
    const NearestOnBox near = nearestOnBox(p.d + p.C * vertex(p.halfA, v), p.halfB);
    least.offer({near.foot, near.gap, featurePair(v, near.feature), near.tie, 0, near.edgeAxis},
                near.normal);
  }
}

void offerVerticesOfB(const BoxPair& p, Least& least) {
  for (unsigned v = 0; v < 8; ++v) {
    const Vec3 p_B = vertex(p.halfB, v);
    const NearestOnBox near = nearestOnBox(p.C.transpose() * (p_B - p.d), p.halfA);
    NormalTie tie = near.tie;
    if (tie == NormalTie::FaceOfB) tie = NormalTie::FaceOfA;
    if (tie == NormalTie::EdgeOfB) tie = NormalTie::EdgeOfA;
    least.offer({p_B, near.gap, featurePair(near.feature, v), tie, near.edgeAxis, 0},
                -(p.C * near.normal));
  }
}

// The midpoint of the edge along `axis` of a box, on the sides that bits 0 and 1 of `which` tell.
Vec3 edgeMiddle(const Vec3& half, int axis, unsigned which) {
  Vec3 m = Vec3::Zero();
  m[nextAxis(axis)] = which & 1 ? half[nextAxis(axis)] : -half[nextAxis(axis)];
  m[lastAxis(axis)] = which & 2 ? half[lastAxis(axis)] : -half[lastAxis(axis)];
  return m;
}

// Edges whose common perpendicular meets both between their ends; other cases are the vertices'.
void offerEdges(const BoxPair& p, int i, int j, Least& least) {
  const Vec3 ea = p.C.col(i), eb = Vec3::Unit(j);
  const double cosine = ea.dot(eb), sine2 = ea.cross(eb).squaredNorm();
  constexpr double kParallel = 1e-18;  // squared sine
  if (sine2 < kParallel) return;
  for (unsigned k = 0; k < 16; ++k) {
    const Vec3 ma = p.d + p.C * edgeMiddle(p.halfA, i, k & 3), mb = edgeMiddle(p.halfB, j, k >> 2);
    const Vec3 between = ma - mb;
    const double alongA = between.dot(ea), alongB = between.dot(eb);
    const double ta = (cosine * alongB - alongA) / sine2, tb = (alongB - cosine * alongA) / sine2;
    if (std::abs(ta) > p.halfA[i] || std::abs(tb) > p.halfB[j]) continue;

    const Vec3 pb = mb + tb * eb, apart = ma + ta * ea - pb;
    const double distance = apart.norm();
    if (distance == 0.0) continue;
    const std::uint64_t feature = featurePair(edgeCode(i, k & 1, k & 2), edgeCode(j, k & 4, k & 8));
    least.offer({pb, distance, feature, NormalTie::Edges, i, j}, apart / distance);
  }
}

}  // namespace

void nearestFeatures(const BoxPair& pair, double tolerance, LocalManifold& out) {
  out.count = 0;
  Least least(tolerance, out);
  offerVerticesOfA(pair, least);
  offerVerticesOfB(pair, least);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) offerEdges(pair, i, j, least);
  }
}

}  // namespace tumble::box_box
