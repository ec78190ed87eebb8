// Chapter 5, collide: the separating-axis test of two boxes.
#include <cmath>

#include "sim/collide/box_box.h"
#include "sim/collide/features.h"

namespace tumble::box_box {

namespace {

// Below this sine two edges are parallel up to rounding: what they could add is s · size.
constexpr double kParallel = 1e-15;

// With eⱼ a unit axis of b's own frame, eⱼ × cᵢ is made of two entries of C without any rounding,
// so even nearly parallel edges give an axis that is exact for boxes within rounding of the given.
double edgeGap(const BoxPair& p, int i, int j, double s) {
  const int j1 = nextAxis(j), j2 = lastAxis(j), i1 = nextAxis(i), i2 = lastAxis(i);
  const double n1 = -p.C(j2, i) / s, n2 = p.C(j1, i) / s;
  const double reachB = p.halfB[j1] * std::abs(n1) + p.halfB[j2] * std::abs(n2);
  const double reachA = p.halfA[i1] * std::abs(n1 * p.C(j1, i1) + n2 * p.C(j2, i1)) +
                        p.halfA[i2] * std::abs(n1 * p.C(j1, i2) + n2 * p.C(j2, i2));
  return std::abs(n1 * p.d[j1] + n2 * p.d[j2]) - (reachA + reachB);
}

Axis widestFace(const BoxPair& p, double bias) {
  const Mat3 absC = p.C.cwiseAbs();
  const Vec3 gapB = p.d.cwiseAbs() - p.halfB - absC * p.halfA;
  const Vec3 gapA = (p.C.transpose() * p.d).cwiseAbs() - p.halfA - absC.transpose() * p.halfB;
  int i = 0, j = 0;
  const double widestA = gapA.maxCoeff(&i), widestB = gapB.maxCoeff(&j);
  if (widestA > widestB + bias) return {NormalTie::FaceOfA, i, 0, widestA};
  return {NormalTie::FaceOfB, 0, j, widestB};
}

}  // namespace

Axis widestAxis(const BoxPair& p, double bias) {
  const Axis face = widestFace(p, bias);
  Axis best = face;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double x = p.C(nextAxis(j), i), y = p.C(lastAxis(j), i);
      const double s = std::sqrt(x * x + y * y);
      if (s < kParallel) continue;
      double gap = edgeGap(p, i, j, s);
      if (face.gap > s * p.size && gap > face.gap) {
        gap = face.gap + s * p.size / face.gap * (gap - face.gap);
      }
      if (gap > best.gap + (best.tie == NormalTie::Edges ? 0.0 : bias)) {
        best = {NormalTie::Edges, i, j, gap};
      }
    }
  }
  return best;
}

Vec3 direction(const BoxPair& p, const Axis& axis) {
  Vec3 n = Vec3::Unit(axis.j);
  if (axis.tie == NormalTie::FaceOfA) n = p.C.col(axis.i);
  if (axis.tie == NormalTie::Edges) n = Vec3::Unit(axis.j).cross(p.C.col(axis.i)).normalized();
  return n.dot(p.d) < 0.0 ? Vec3(-n) : n;
}

}  // namespace tumble::box_box
