// Meshes in pieces, for tests of collide.
#pragma once

#include <memory>
#include <numbers>
#include <vector>

#include "sim/math/rotation.h"
#include "sim/shape/pieces.h"
#include "tests/body/solids.h"
#include "tests/collide/random_pose.h"

namespace tumble::meshes {

/// About the middle of its height.
inline Mesh prism(const std::vector<Vec3>& outline, double height) {
  Mesh mesh = solids::prism(outline, height).mesh();
  mesh.origin = {0.8, 0.8, 0.5 * height};
  mesh.pieces = std::make_shared<const Pieces>(piecesOf(*mesh.solid, PieceKind::Good, 0.0));
  return mesh;
}

/// A ring about z of flat faces all around: its section is a square on edge, `thick` from its
/// middle to a corner.
inline Mesh ring(int around, double r = 1.0, double thick = 0.3) {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < 4; ++k) {
      double s = 0.0, c = 0.0;
      sinCos(2.0 * std::numbers::pi * i / around, s, c);
      const double out = r + (k == 0 ? thick : k == 2 ? -thick : 0.0);
      points.emplace_back(out * c, out * s, k == 1 ? thick : k == 3 ? -thick : 0.0);
      const int j = (i + 1) % around, l = (k + 1) % 4;
      faces.push_back({4 * i + k, 4 * j + k, 4 * j + l, 4 * i + l});
    }
  Mesh mesh{std::make_shared<const Polyhedron>(makePolyhedron(points, faces))};
  mesh.origin = -points[0];
  mesh.pieces = std::make_shared<const Pieces>(piecesOf(*mesh.solid, PieceKind::Good, 1e-9));
  return mesh;
}

inline Mesh someMesh(Random& random) {
  switch (random.below(3)) {
    case 0:
      return prism({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, 1);
    case 1:
      return prism({{0, 0, 0},
                    {2, 0, 0},
                    {2, 1.5, 0},
                    {1.75, 1.5, 0},
                    {1.75, 0.25, 0},
                    {0.25, 0.25, 0},
                    {0.25, 1.5, 0},
                    {0, 1.5, 0}},
                   0.5);
    default:
      return ring(6);
  }
}

}  // namespace tumble::meshes
