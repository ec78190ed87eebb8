// Chapter 6, problem: one contact with Coulomb friction while everything else keeps still.
#pragma once

#include "sim/math/vec.h"

namespace tumble {

/// Finds λ of one frictional contact with  u = W λ + c:
///   λ = 0 and u_n ≥ 0;  or u = 0 and |λt| ≤ mu λn (sticks);
///   or u_n = 0 and λt = −mu λn d, u_t = |u_t| d (slides along the unit vector d).
/// Sliding is one equation for d, solved by Newton's method on the circle from three guesses in
/// turn; where they all fail the projection λ ← Π_K(λ − ρ û) is iterated instead.
/// @param W  3×3, symmetric positive definite, rows n, t1, t2 [1/kg]
/// @param c  u without λ [m/s]
/// @param start  λ to start from
Vec3 solveFrictionBlock(const Mat3& W, const Vec3& c, double mu, const Vec3& start);

}  // namespace tumble
