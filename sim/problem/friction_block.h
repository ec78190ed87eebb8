// Chapter 6, problem: one contact with Coulomb friction while everything else keeps still.
#pragma once

#include "sim/math/vec.h"
#include "sim/problem/lanes.h"

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

/// The same where the contact is known to push, c_n < 0, and not to stick; `stick` is the λ that
/// would hold it, or 0. The slip direction is good enough when Newton turns it by no more than
/// `enough` [rad]: it then errs by the square of that.
Vec3 slideFrictionBlock(const Mat3& W, const Vec3& c, double mu, const Vec3& start,
                        const Vec3& stick, double enough);

/// The first guess of slideFrictionBlock, that the slip goes on as in `start`, in the given lanes.
/// Returns in which of them Newton finds λ from there; `lambda` is good in these alone.
LaneMask slideAbreast(const LanesSymmetric& W, const Lanes3& c, Lanes mu, const Lanes3& start,
                      double enough, LaneMask lanes, Lanes3& lambda);

/// W⁻¹, symmetric, or 0 if W is singular to rounding.
Mat3 inverseOfBlock(const Mat3& W);

}  // namespace tumble
