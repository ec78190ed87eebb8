// Chapter 5, collide: box against box: axis, then faces seen along it, then the manifold.
#include "sim/collide/box_box.h"

#include <algorithm>
#include <cmath>

#include "sim/collide/pairs.h"
#include "sim/math/frames.h"

namespace tumble::pairs {

namespace {

using box_box::Axis;
using box_box::BoxPair;
using box_box::LocalManifold;
using box_box::LocalPoint;

// Differences below this part of the boxes' size are rounding.
constexpr double kRelativeTolerance = 1e-9;

BoxPair seenFromB(const Box& a, const Pose& poseA, const Box& b, const Pose& poseB) {
  const Mat3 Ra = poseA.q.toRotationMatrix(), RbT = poseB.q.toRotationMatrix().transpose();
  return {a.half, b.half, RbT * Ra, RbT * (poseA.x - poseB.x),
          std::sqrt(a.half.norm() * b.half.norm())};
}

// Leaves one point of each group that lies within the tolerance, the lowest feature first.
void sortAndMerge(LocalManifold& m, double tolerance) {
  std::sort(m.points, m.points + m.count,
            [](const LocalPoint& p, const LocalPoint& q) { return p.feature < q.feature; });
  int kept = 0;
  for (int k = 0; k < m.count; ++k) {
    const LocalPoint& candidate = m.points[k];
    const bool isNew = std::none_of(m.points, m.points + kept, [&](const LocalPoint& p) {
      return (p.pb - candidate.pb).norm() <= tolerance &&
             std::abs(p.separation - candidate.separation) <= tolerance;
    });
    if (isNew) m.points[kept++] = candidate;
  }
  m.count = kept;
}

ContactPoint toWorld(const LocalPoint& local, const Vec3& n, const Mat3& Ra, const Pose& poseB,
                     const Mat3& Rb) {
  ContactPoint c;
  c.n = n;
  c.separation = local.separation;
  c.feature = local.feature;
  c.tie = local.tie;
  c.pb = poseB.x + Rb * local.pb;
  c.pa = c.pb + c.separation * n;
  c.p = c.pb + 0.5 * c.separation * n;
  const bool edges = c.tie == NormalTie::Edges;
  if (edges || c.tie == NormalTie::EdgeOfA) c.ea = Ra.col(local.i);
  if (edges || c.tie == NormalTie::EdgeOfB) c.eb = Rb.col(local.j);
  return c;
}

void keepWithin(double margin, LocalManifold& m) {
  const LocalPoint* end = std::remove_if(
      m.points, m.points + m.count, [&](const LocalPoint& p) { return p.separation > margin; });
  m.count = static_cast<int>(end - m.points);
}

}  // namespace

double separation(const Box& a, const Pose& poseA, const Box& b, const Pose& poseB) {
  return box_box::widestAxis(seenFromB(a, poseA, b, poseB), 0.0).gap;
}

ContactPoint separatingPlane(const Box& a, const Pose& poseA, const Box& b, const Pose& poseB) {
  const BoxPair pair = seenFromB(a, poseA, b, poseB);
  const Axis axis = box_box::widestAxis(pair, 0.0);
  ContactPoint c;
  c.n = poseB.q * box_box::direction(pair, axis);
  c.separation = axis.gap;
  c.tie = axis.tie;
  if (c.tie == NormalTie::Edges) {
    c.ea = poseA.q * Vec3::Unit(axis.i);
    c.eb = poseB.q * Vec3::Unit(axis.j);
  }
  return c;
}

void collide(const Box& a, const Pose& poseA, const Box& b, const Pose& poseB, double margin,
             Manifold& out) {
  const BoxPair pair = seenFromB(a, poseA, b, poseB);
  const double tolerance = kRelativeTolerance * pair.size;
  const Axis axis = box_box::widestAxis(pair, tolerance);
  if (axis.gap > margin) return;

  LocalManifold local;
  box_box::clipFaces(pair, axis, tolerance, local);
  keepWithin(margin, local);
  if (local.count == 0) {
    box_box::nearestFeatures(pair, tolerance, local);
    keepWithin(margin, local);
  }
  sortAndMerge(local, tolerance);

  const Mat3 Ra = poseA.q.toRotationMatrix(), Rb = poseB.q.toRotationMatrix();
  const Vec3 n = Rb * local.n;
  for (int k = 0; k < local.count; ++k) {
    out.push_back(toWorld(local.points[k], n, Ra, poseB, Rb));
  }
}

}  // namespace tumble::pairs
