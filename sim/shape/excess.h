// Chapter 2, shape: how far a convex solid reaches out of a mesh.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "sim/shape/box_tree.h"
#include "sim/shape/interior.h"
#include "sim/shape/polyhedron.h"

namespace tumble {

/// The distance from a mesh, in the frame of its polyhedron.
class MeshDistance {
 public:
  explicit MeshDistance(const Polyhedron& solid);

  /// Distance [m] from the surface to p: > 0 outside, < 0 inside.
  /// @param reach  [m] known to be no less than its size
  double operator()(const Vec3& p, double reach) const;

  /// The point of the surface nearest to p.
  Vec3 nearest(const Vec3& p) const;

  /// Boxes and triangles looked at so far.
  long looks() const { return looks_; }

 private:
  struct Nearest {
    double squared;  ///< [m²]
    Vec3 point = Vec3::Zero();
  };
  void descend(int node, const Vec3& p, Nearest& best) const;

  Shape mesh_;
  Interior interior_;
  std::vector<std::array<Vec3, 3>> triangles_;
  BoxTree tree_;
  mutable long looks_ = 0;
};

/// How far a convex solid reaches out of a mesh.
struct Excess {
  double bound = 0.0;         ///< [m] no point of the solid is further from the mesh
  Vec3 where = Vec3::Zero();  ///< a point of the solid far from the mesh, if the bound is > allowed
  long looks = 0;             ///< at triangles of the mesh and faces of the solid
};

/// Boxes are halved where the distance at their middle, which changes by no more than the way from
/// there, does not tell; the largest first (Piyavskii 1972, Shubert 1972).
/// @param allowed  [m] > 0; the bound is sought no further once it is less. A solid that reaches
/// out
///                 by more than 15/16 of it may be taken for one that reaches out by more.
/// @param most  looks after which it is sought no further
Excess excessOf(const Polyhedron& convex, const MeshDistance& distance, double allowed, long most);

}  // namespace tumble
