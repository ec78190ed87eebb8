// Chapter 5, collide: box against half-space, vertex by vertex.
#include "sim/collide/features.h"
#include "sim/collide/pairs.h"

namespace tumble::pairs {

namespace {

// Heights above the plane: of the centre, and what one step along each half edge adds. [m]
struct Heights {
  double centre;
  Vec3 step;
};

Heights heights(const Box& a, const Mat3& R, const Vec3& x, const HalfSpace& b) {
  return {b.n.dot(x) - b.d, (R.transpose() * b.n).cwiseProduct(a.half)};
}

// Sums in one order, so that the lowest vertex has exactly the separation of the box.
double vertexHeight(const Heights& h, double sx, double sy, double sz) {
  return h.centre + ((sx * h.step.x() + sy * h.step.y()) + sz * h.step.z());
}

}  // namespace

double separation(const Box& a, const Pose& poseA, const HalfSpace& b, const Pose&) {
  Heights h = heights(a, poseA.q.toRotationMatrix(), poseA.x, b);
  h.step = h.step.cwiseAbs();
  return vertexHeight(h, -1.0, -1.0, -1.0);
}

ContactPoint separatingPlane(const Box& a, const Pose& poseA, const HalfSpace& b,
                             const Pose& poseB) {
  ContactPoint c;
  c.n = b.n;
  c.separation = separation(a, poseA, b, poseB);
  c.tie = NormalTie::FaceOfB;
  return c;
}

void collide(const Box& a, const Pose& poseA, const HalfSpace& b, const Pose&, double margin,
             Manifold& out) {
  const Mat3 R = poseA.q.toRotationMatrix();
  const Heights h = heights(a, R, poseA.x, b);
  for (unsigned v = 0; v < 8; ++v) {
    const Vec3 side(v & 1 ? 1.0 : -1.0, v & 2 ? 1.0 : -1.0, v & 4 ? 1.0 : -1.0);
    const double gap = vertexHeight(h, side.x(), side.y(), side.z());
    if (gap > margin) continue;

    ContactPoint c;
    c.n = b.n;
    c.separation = gap;
    c.feature = featurePair(v, faceCode(1, true));
    c.tie = NormalTie::FaceOfB;
    c.pa = poseA.x + R * side.cwiseProduct(a.half);
    c.pb = c.pa - gap * b.n;
    c.p = c.pa - 0.5 * gap * b.n;
    out.push_back(c);
  }
}

}  // namespace tumble::pairs
