// Chapter 0, math: on which side of a plane a point is.
#pragma once

#include "sim/math/vec.h"

namespace tumble {

/// The side of the plane through a, b, c on which d is: +1 where they run counter-clockwise about
/// the viewer, −1 on the other, 0 in the plane.
///   sign of (b − a) × (c − a) · (d − a)
/// Always right for the doubles given: a floating-point filter, and where that leaves a doubt the
/// exact determinant as a sum of doubles that do not overlap (Shewchuk, "Adaptive Precision
/// Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997, §4.3 and Grow-Expansion).
/// For coordinates between 1e-60 and 1e90 in size, or 0: no product may leave the range of doubles.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Twice the area vector of the triangle a, b, c:  (b − a) × (c − a). Its direction is right to
/// 1e-11 even where the three are in line to rounding of their size: there it is found from the
/// doubles given in twice the digits.
Vec3 twiceArea(const Vec3& a, const Vec3& b, const Vec3& c);

/// Whether the edge between p and q passes through the inside of the triangle a, b, c: decided
/// exactly. What only touches does not.
bool pierces(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace tumble
