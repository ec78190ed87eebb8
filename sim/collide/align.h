// Chapter 5, collide: the normal between vertices, edges and rims of which one at least is a rim.
#pragma once

#include "sim/collide/contact_point.h"
#include "sim/collide/rim.h"

namespace tumble {

/// The outermost point of the rim of a, or of b, along the normal of a contact; bend 0, lean 1
/// and no tangent if that body has none there.
RimPoint rimOfA(const ContactPoint& c);
RimPoint rimOfB(const ContactPoint& c);

/// Turns n from where it is to where it is right, for ties `Points`, `EdgeOfA` and `EdgeOfB`:
///   pa(n) − pb(n) along n, but for its part along an edge, to which n is square
/// by Newton's method; the derivative along tangents t of the sphere of normals is
///   t·(pa − pb)′ = −(n·(pa − pb) + Σ bend (along·t)²).
/// Sets n, pa, pb (feet on edges too) and the separation, not p. World frame or any other.
/// @param fromA, fromB  [m] vertices, points of edges, or centres of rims
/// @return false where n would not be the widest near it
bool alignNormal(ContactPoint& c, const Vec3& fromA, const Vec3& fromB);

}  // namespace tumble
