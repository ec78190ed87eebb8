#include "sim/contact/impulse.h"

#include <stdexcept>

namespace tumble {

double inverseEffectiveMass(const RigidBody& a, const RigidBody& b, const Vec3& p,
                            const Vec3& direction) {
  const Vec3 armA = (p - a.x).cross(direction), armB = (p - b.x).cross(direction);
  return a.invM + b.invM + armA.dot(a.Iinv * armA) + armB.dot(b.Iinv * armB);
}

double collisionImpulse(const RigidBody& a, const RigidBody& b, const ContactPoint& c, double e) {
  if (!(e >= 0.0 && e <= 1.0)) throw std::invalid_argument("restitution must lie in [0, 1]");
  const double vrel = c.n.dot(pointVelocity(a, c.p) - pointVelocity(b, c.p));
  const double k = inverseEffectiveMass(a, b, c.p, c.n);
  return vrel < 0.0 && k > 0.0 ? -(1.0 + e) * vrel / k : 0.0;
}

}  // namespace tumble
