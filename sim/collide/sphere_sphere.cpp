// Chapter 5, collide: sphere against sphere.
#include "sim/collide/pairs.h"

namespace tumble::pairs {

namespace {

// [m] Nearer centres than this have no line between them: their squared distance underflows.
constexpr double kConcentric = 1e-140;

}  // namespace

double separation(const Sphere& a, const Pose& poseA, const Sphere& b, const Pose& poseB) {
  return (poseA.x - poseB.x).norm() - (a.r + b.r);
}

// n runs along the line of centres; concentric balls get the world's Y.
ContactPoint separatingPlane(const Sphere& a, const Pose& poseA, const Sphere& b,
                             const Pose& poseB) {
  const Vec3 d = poseA.x - poseB.x;
  const double distance = d.norm();
  ContactPoint c;
  c.n = distance > kConcentric ? Vec3(d / distance) : Vec3::UnitY();
  c.separation = distance - (a.r + b.r);
  c.tie = NormalTie::Points;
  c.pa = poseA.x;
  c.pb = poseB.x;
  c.ra = a.r;
  c.rb = b.r;
  c.p = c.pb + (b.r + 0.5 * c.separation) * c.n;
  return c;
}

void collide(const Sphere& a, const Pose& poseA, const Sphere& b, const Pose& poseB, double margin,
             Manifold& out) {
  const ContactPoint c = separatingPlane(a, poseA, b, poseB);
  if (c.separation <= margin) out.push_back(c);
}

}  // namespace tumble::pairs
