// Chapter 2, shape: solids with flat faces.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/math/vec.h"

namespace tumble {

/// A solid bounded by flat polygons. Corners of a face run counter-clockwise seen from outside;
/// each edge belongs to two faces, which run through it in opposite directions.
struct Polyhedron {
  /// An edge between two points; `left` is the face that runs from the first to the second.
  struct Edge {
    int from, to;     ///< indices into points
    int left, right;  ///< indices into faces
  };

  std::vector<Vec3> points;             ///< [m]
  std::vector<std::vector<int>> faces;  ///< indices into points, three or more each

  // What follows from these, found once by `findEdges`.
  std::vector<Edge> edges = {};              ///< by the face that runs through each first
  std::vector<Vec3> normals = {};            ///< [1] of the faces, outward unit
  std::vector<std::vector<int>> sides = {};  ///< of each face, the edge that leaves each corner
};

/// Fills in edges, normals and sides. `makePolyhedron` and `convexHull` do.
void findEdges(Polyhedron& solid);

/// What keeps faces from bounding a solid. The text names the edge by its points, counted from 1 as
/// in OBJ files, with their positions.
class NotASolid : public std::invalid_argument {
 public:
  NotASolid(const std::string& what, int face) : std::invalid_argument(what), face_(face) {}
  int face() const { return face_; }  ///< index of the face that shows it; −1 for none

 private:
  int face_;
};

/// The polyhedron with these points and faces. Points may stand anywhere: the first is subtracted
/// from all, so that a body far from its author's origin keeps all its digits. A face that is not
/// flat to 1e-12 of its size is cut into triangles.
/// @throws NotASolid  with the offending edge, for an index without a point, an edge of no length,
///                    a face without area, an edge with one face, with three, or two that run the
///                    same way, shells that overlap or are inside out, points 1e60 m apart, a
///                    volume that may be rounding alone, or a list without faces.
Polyhedron makePolyhedron(std::vector<Vec3> points, std::vector<std::vector<int>> faces);

/// Twice the area vector [m²] of a face, outward:  Σ (pᵢ − p₀) × (pᵢ₊₁ − p₀)  (Newell).
Vec3 areaVector(const Polyhedron& solid, const std::vector<int>& face);

/// A face as triangles, by cutting ears (Meisters 1975), each counter-clockwise like the face.
void cutIntoTriangles(const Polyhedron& solid, const std::vector<int>& face,
                      std::vector<std::array<int, 3>>& triangles);

}  // namespace tumble
