// Chapter 0, math: what motion in elliptic functions is made of. Additions, multiplications,
// divisions and square roots alone, so that every compiler and library gives the same bits.
#pragma once

namespace tumble {

/// e^x, to within 1 unit in the last place for −708 ≤ x ≤ 709; 0 below, infinity above.
double exponential(double x);

/// The arithmetic-geometric mean of a > 0 and b ≥ 0 (Gauss):
///   a ← (a + b)/2,  b ← √(a b)  until both are one.  K(m) = π / (2 agm(1, √(1 − m))).
/// 0 if b = 0, NaN unless both are finite. Relative error below 4e-16.
double agm(double a, double b);

/// Carlson's symmetric elliptic integral of the first kind, for x, y, z ≥ 0, at most one of them 0:
///   RF(x, y, z) = ½ ∫₀^∞ dt / √((t + x)(t + y)(t + z)),   F(φ|m) = s RF(1 − s², 1 − m s², 1),  s =
///   sin φ.
///   Carlson, Numerical Computation of Real or Complex Elliptic Integrals, 1995: duplication, then
///   the series of order 7. Relative error below 1e-15. Infinite if two of them are 0, NaN unless
///   all are finite.
double carlsonRF(double x, double y, double z);

}  // namespace tumble
