// Chapter 3, body: what a polyhedron weighs, by Green's theorem twice (slide SF27).
#pragma once

#include "sim/shape/polyhedron.h"

namespace tumble {

/// Volume [m³], centroid [m, the polyhedron's frame] and, for density 1, the inertia tensor [m⁵]
/// about the centroid, with its products of inertia: the entry xy is −∫ x y dV.
struct VolumeIntegrals {
  double volume = 0.0;
  Vec3 centre = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
};

/// The integrals of a closed polyhedron, exact but for rounding.
///   ∫ ∂F/∂x dV = ∮ F nₓ dA      turns volume into faces (Gauss),
///   ∬ αᵖ βᑫ dα dβ = ∮ αᵖ⁺¹ βᑫ dβ / (p + 1)   turns faces, seen along their steepest axis, into
///   edges (Green). Mirtich, "Fast and accurate computation of polyhedral mass properties",
///   J. Graphics Tools 1(2), 1996. Departures: normals need no unit length, so no root is taken;
///   edges by Gauss' rule of three points, exact to degree five; all about the centroid, found
///   first.
VolumeIntegrals integrate(const Polyhedron& solid);

}  // namespace tumble
