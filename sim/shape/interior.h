// Chapter 2, shape: which points are inside.
#pragma once

#include <vector>

#include "sim/shape/shape.h"

namespace tumble {

/// Axis-aligned box around a shape in the frame in which it was given, whatever its origin.
Aabb boxAsGiven(const Shape& shape);

/// Tells inside from outside for one shape, in the frame in which it was given (slide SF26: "needs
/// a volume test"). A mesh by counting the faces that a ray along +x crosses: each is cut into
/// triangles, and these are sorted into cells of the yz plane. A ray through an edge counts exactly
/// one of the two faces, so that no ray slips through.
class Interior {
 public:
  /// The shape must outlive it.
  explicit Interior(const Shape& shape);
  bool contains(const Vec3& p) const;

 private:
  struct Triangle {
    Vec3 corner[3];
    int index[3];  ///< of the corners, so that both faces of an edge see it alike
    Vec3 n;        ///< twice the area vector
  };
  void sortTriangles(const Polyhedron& solid);
  bool crosses(const Triangle& triangle, const Vec3& p) const;
  std::size_t cellOf(double y, double z) const;

  const Shape& shape_;
  Aabb box_;
  int cells_ = 0;  ///< each way
  std::vector<Triangle> triangles_;
  std::vector<std::vector<int>> cell_;  ///< triangles over each cell
};

}  // namespace tumble
