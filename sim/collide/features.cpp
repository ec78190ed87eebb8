// Chapter 5, collide: the feature of a box that is nearest to a point.
#include "sim/collide/features.h"

#include <algorithm>
#include <cmath>

namespace tumble {

namespace {

// [m] A point nearer than this is on the surface: its squared distance underflows.
constexpr double kOnSurface = 1e-140;

NearestOnBox nearestFromInside(const Vec3& p, const Vec3& half) {
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(p[k]) - half[k] > std::abs(p[axis]) - half[axis]) axis = k;
  }
  const double side = p[axis] < 0.0 ? -1.0 : 1.0;
  NearestOnBox nearest{p,
                       Vec3::Zero(),
                       std::abs(p[axis]) - half[axis],
                       faceCode(axis, side > 0.0),
                       NormalTie::FaceOfB,
                       0};
  nearest.foot[axis] = side * half[axis];
  nearest.normal[axis] = side;
  return nearest;
}

}  // namespace

NearestOnBox nearestOnBox(const Vec3& p, const Vec3& half) {
  const Vec3 foot = p.cwiseMax(-half).cwiseMin(half);
  const Vec3 away = p - foot;
  const double gap = away.norm();
  if (gap < kOnSurface) return nearestFromInside(p, half);

  // The axes along which p lies beyond the box tell face (one), edge (two) and vertex (three).
  NearestOnBox nearest{foot, away / gap, gap, 0, NormalTie::Points, 0};
  int beyond = 0, lastBeyond = 0;
  for (int k = 0; k < 3; ++k) {
    if (away[k] == 0.0) {
      nearest.edgeAxis = k;
    } else {
      ++beyond;
      lastBeyond = k;
    }
  }
  const int e = nearest.edgeAxis;
  if (beyond == 1) {
    nearest.tie = NormalTie::FaceOfB;
    nearest.feature = faceCode(lastBeyond, p[lastBeyond] > 0.0);
  } else if (beyond == 2) {
    nearest.tie = NormalTie::EdgeOfB;
    nearest.feature = edgeCode(e, p[nextAxis(e)] > 0.0, p[lastAxis(e)] > 0.0);
  } else {
    nearest.feature = vertexCode(p.x() > 0.0, p.y() > 0.0, p.z() > 0.0);
  }
  return nearest;
}

}  // namespace tumble
