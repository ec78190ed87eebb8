#include "sim/problem/cone.h"

#include <algorithm>
#include <cmath>

namespace tumble {

Vec3 projectOnFrictionCone(const Vec3& p, double mu) {
  const double tangential = std::sqrt(p[1] * p[1] + p[2] * p[2]);
  if (p[0] >= 0.0 && tangential <= mu * p[0]) return p;
  const double along = (p[0] + mu * tangential) / (1.0 + mu * mu);
  if (along <= 0.0) return Vec3::Zero();
  const double shrink = tangential > 0.0 ? mu * along / tangential : 0.0;
  return {along, shrink * p[1], shrink * p[2]};
}

double coneResidual(const Cone& cone, const double* lambda, const double* u, double rho) {
  const auto push = [&] {
    return std::abs(std::min(lambda[0] / rho, u[0]));  // no difference in which a large λ hides u
  };
  switch (cone.kind) {
    case ConeKind::Push:
      return push();
    case ConeKind::Equality:
      return std::abs(u[0]);
    case ConeKind::Slide:
      return std::max(push(), std::abs(lambda[1] + cone.mu * lambda[0]) / rho);
    case ConeKind::Friction:
      break;
  }
  const double slip = std::sqrt(u[1] * u[1] + u[2] * u[2]);
  const Vec3 force(lambda[0], lambda[1], lambda[2]);
  const Vec3 velocity(u[0] + cone.mu * slip, u[1], u[2]), asked = force - rho * velocity;
  const Vec3 taken = projectOnFrictionCone(asked, cone.mu);
  // Inside the cone as well, no difference in which a large λ hides u.
  if (taken == asked) return velocity.lpNorm<Eigen::Infinity>();
  return (force - taken).lpNorm<Eigen::Infinity>() / rho;
}

}  // namespace tumble
