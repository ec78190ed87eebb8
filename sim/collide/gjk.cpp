#include "sim/collide/gjk.h"

namespace tumble::gjk {
namespace {

// Below this part of its edges' product a triangle or a tetrahedron is flat up to rounding.
constexpr double kFlat = 1e-14;

// The best found: nearest point, and the corners that carry it with their shares.
struct Best {
  double square = std::numeric_limits<double>::infinity();
  Vec3 v = Vec3::Zero();
  int index[4] = {};
  double weight[4] = {};
  int count = 0;

  void offer(const Vec3& nearest, std::initializer_list<int> corners,
             std::initializer_list<double> weights) {
    const double s = nearest.squaredNorm();
    if (!(s < square)) return;
    square = s;
    v = nearest;
    count = static_cast<int>(corners.size());
    std::copy(corners.begin(), corners.end(), index);
    std::copy(weights.begin(), weights.end(), weight);
  }
};

void offerSegment(const Simplex& s, int i, int j, Best& best) {
  const Vec3 &a = s.corner[i].w, &b = s.corner[j].w;
  const Vec3 ab = b - a;
  const double t = -a.dot(ab) / ab.squaredNorm();
  if (t > 0.0 && t < 1.0) best.offer(a + t * ab, {i, j}, {1.0 - t, t});
}

void offerTriangle(const Simplex& s, int i, int j, int k, Best& best) {
  const Vec3 &a = s.corner[i].w, &b = s.corner[j].w, &c = s.corner[k].w;
  const Vec3 ab = b - a, ac = c - a, n = ab.cross(ac);
  const double area2 = n.squaredNorm();
  if (!(area2 > kFlat * kFlat * ab.squaredNorm() * ac.squaredNorm())) return;
  const double wb = n.dot(ac.cross(a)) / area2, wc = n.dot(a.cross(ab)) / area2;
  if (wb > 0.0 && wc > 0.0 && wb + wc < 1.0)
    best.offer((n.dot(a) / area2) * n, {i, j, k}, {1.0 - wb - wc, wb, wc});
}

bool holdsOrigin(const Simplex& s) {
  for (int l = 0; l < 4; ++l) {
    const Vec3& a = s.corner[(l + 1) % 4].w;
    const Vec3 ab = s.corner[(l + 2) % 4].w - a, ac = s.corner[(l + 3) % 4].w - a;
    const Vec3 n = ab.cross(ac), up = s.corner[l].w - a;
    const double height = n.dot(up);
    if (!(std::abs(height) > kFlat * n.norm() * up.norm())) return false;
    if (-n.dot(a) * height < 0.0) return false;
  }
  return true;
}

}  // namespace

Vec3 nearestOf(Simplex& simplex) {
  if (simplex.count == 4 && holdsOrigin(simplex)) return Vec3::Zero();
  Best best;
  const int last = simplex.count - 1;
  best.offer(simplex.corner[last].w, {last}, {1.0});
  for (int j = 0; j < last; ++j) {
    offerSegment(simplex, j, last, best);
    for (int k = 0; k < j; ++k) offerTriangle(simplex, k, j, last, best);
  }
  const Simplex before = simplex;
  simplex.count = best.count;
  for (int m = 0; m < best.count; ++m) {
    simplex.corner[m] = before.corner[best.index[m]];
    simplex.corner[m].weight = best.weight[m];
  }
  return best.v;
}

}  // namespace tumble::gjk
