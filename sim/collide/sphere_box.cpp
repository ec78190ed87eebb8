// Chapter 5, collide: sphere against box, by the point of the box nearest to the centre of the
// ball.
#include "sim/collide/features.h"
#include "sim/collide/pairs.h"
#include "sim/math/frames.h"

namespace tumble::pairs {

double separation(const Sphere& a, const Pose& poseA, const Box& b, const Pose& poseB) {
  const Vec3 centre_B = toBody(poseB, poseA.x);
  const Vec3 beyond = centre_B.cwiseAbs() - b.half;
  const double inside = beyond.maxCoeff();
  return (inside > 0.0 ? beyond.cwiseMax(0.0).norm() : inside) - a.r;
}

ContactPoint separatingPlane(const Sphere& a, const Pose& poseA, const Box& b, const Pose& poseB) {
  const NearestOnBox nearest = nearestOnBox(toBody(poseB, poseA.x), b.half);
  const double gap = nearest.gap - a.r;
  ContactPoint c;
  c.n = poseB.q * nearest.normal;
  c.separation = gap;
  c.feature = featurePair(0, nearest.feature);
  c.tie = nearest.tie;
  c.pa = poseA.x;
  c.pb = toWorld(poseB, nearest.foot);
  c.ra = a.r;
  if (c.tie == NormalTie::EdgeOfB) c.eb = poseB.q * Vec3::Unit(nearest.edgeAxis);
  c.p = c.pb + 0.5 * gap * c.n;
  return c;
}

void collide(const Sphere& a, const Pose& poseA, const Box& b, const Pose& poseB, double margin,
             Manifold& out) {
  const ContactPoint c = separatingPlane(a, poseA, b, poseB);
  if (c.separation <= margin) out.push_back(c);
}

}  // namespace tumble::pairs
