// Chapter 5, collide: sphere against half-space.
#include "sim/collide/features.h"
#include "sim/collide/pairs.h"

namespace tumble::pairs {

double separation(const Sphere& a, const Pose& poseA, const HalfSpace& b, const Pose&) {
  return b.n.dot(poseA.x) - b.d - a.r;
}

ContactPoint separatingPlane(const Sphere& a, const Pose& poseA, const HalfSpace& b, const Pose&) {
  const double height = b.n.dot(poseA.x) - b.d;
  const double gap = height - a.r;
  ContactPoint c;
  c.n = b.n;
  c.separation = gap;
  c.feature = featurePair(0, faceCode(1, true));
  c.tie = NormalTie::FaceOfB;
  c.pa = poseA.x;
  c.pb = poseA.x - height * b.n;
  c.ra = a.r;
  c.p = c.pb + 0.5 * gap * b.n;
  return c;
}

void collide(const Sphere& a, const Pose& poseA, const HalfSpace& b, const Pose& poseB,
             double margin, Manifold& out) {
  const ContactPoint c = separatingPlane(a, poseA, b, poseB);
  if (c.separation <= margin) out.push_back(c);
}

}  // namespace tumble::pairs
