// Chapter 5, collide: the surface of an ellipsoid where its normal is known.
#pragma once

#include "sim/collide/contact_point.h"
#include "sim/math/vec.h"

namespace tumble {

/// The point of an ellipsoid that is outermost along m, from its centre:  E Eᵀ m / |Eᵀ m|,
/// E = R diag(half).
/// @param half  [m] semi-axes, along the columns of R [1];  m ≠ 0
Vec3 outermostOnEllipsoid(const Vec3& half, const Mat3& R, const Vec3& m);

/// The torus that bends as an ellipsoid does at one point: a circle of radius ρ₁ − ρ₂ in the plane
/// of n and of the direction of least curvature, thickened to ρ₂. World axes, about the centre.
struct Osculating {
  Vec3 centre;         ///< [m] of the circle
  Vec3 axis;           ///< [1] of the circle, in the tangent plane; 0 where ρ₁ = ρ₂
  double rim = 0.0;    ///< [m] ρ₁ − ρ₂
  double round = 0.0;  ///< [m] ρ₂, the least radius of curvature
};

/// Where the unit vector n is the outward normal. On the tangent plane the radii of curvature are
/// the eigenvalues of  P (E Eᵀ − p pᵀ) P / h,  h = |Eᵀ n|,  p the point, P = 1 − n nᵀ: the second
/// derivative of the support function h.
Osculating osculatingTorus(const Vec3& half, const Mat3& R, const Vec3& n);

/// Puts that torus in the place of the ellipsoid that a contact is on, as c.n shows it: pa is the
/// centre of the circle, or of the ball that it is without one; ra, rimA and ea. The same of b.
/// @param x, R  [m], [1] where the ellipsoid stands
void bendAsEllipsoidA(ContactPoint& c, const Vec3& x, const Mat3& R);
void bendAsEllipsoidB(ContactPoint& c, const Vec3& x, const Mat3& R);

}  // namespace tumble
