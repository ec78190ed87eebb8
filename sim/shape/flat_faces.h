// Chapter 2, shape: faces that lie in one plane, as one.
#pragma once

#include <vector>

#include "sim/shape/polyhedron.h"

namespace tumble {

/// The faces of a closed surface, those that hang together and lie in one plane to `tolerance` [m]
/// joined into polygons – but not around a hole –, and without the points that are then no corners:
/// fewer than three faces meet there.
struct FlatFaces {
  std::vector<std::vector<int>> faces;  ///< indices into the points of the surface
  std::vector<int> first;               ///< per face: one of the surface's that is a part of it
};

/// All faces as they are.
FlatFaces allFacesOf(const Polyhedron& solid);

/// Where joining would leave no closed surface all faces stay as they were.
FlatFaces flatFacesOf(const Polyhedron& solid, double tolerance);

/// A convex surface of triangles with such faces, without the points that are then no corners.
/// Where joining would leave no closed convex surface it stays as it was.
Polyhedron withFlatFaces(const Polyhedron& triangles, double tolerance);

}  // namespace tumble
