// Meshes in pieces, for tests of collide.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

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

/// A ring about z of flat faces all around: its section is a square on edge.
inline Mesh ring(int around) {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  const double turn = 2.0 * 3.14159265358979323846;
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < 4; ++k) {
      const double a = turn * i / around;
      const double r = k == 0 ? 1.3 : k == 2 ? 0.7 : 1.0, z = k == 1 ? 0.3 : k == 3 ? -0.3 : 0.0;
      points.emplace_back(r * std::cos(a), r * std::sin(a), z);
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
