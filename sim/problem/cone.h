// Chapter 6, problem: the cones that multipliers live in.
#pragma once

#include "sim/problem/problem.h"

namespace tumble {

/// Number of rows of a cone.
constexpr int coneRows(ConeKind kind) {
  switch (kind) {
    case ConeKind::Friction:
      return 3;
    case ConeKind::Slide:
      return 2;
    default:
      return 1;
  }
}

/// Nearest point of the friction cone {|(y, z)| ≤ mu x} to p = (x, y, z).
Vec3 projectOnFrictionCone(const Vec3& p, double mu);

/// Natural map of one cone, in units of u: (λ − Π_K(λ − ρ û))/ρ, the largest of its entries.
/// λ and u point at the rows of the cone; û = u + mu |u_t| n for friction (de Saxcé).
double coneResidual(const Cone& cone, const double* lambda, const double* u, double rho);

}  // namespace tumble
