// Chapter 2, shape: triangles of a convex surface that lie in one plane.
#pragma once

#include "sim/shape/polyhedron.h"

namespace tumble {

/// A convex surface of triangles with those that lie in one plane to `tolerance` [m] joined into
/// polygons, and without the points that are then no corners: fewer than three faces meet there.
/// Where joining would leave no closed convex surface it stays as it was.
Polyhedron withFlatFaces(const Polyhedron& triangles, double tolerance);

}  // namespace tumble
