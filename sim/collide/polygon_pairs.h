// Chapter 5, collide: polyhedra that need not be convex, as their polygons (slide SH28: "look at
// pairs of polygons; coherence; hierarchy: most false hits go"). Shares nothing with the convex
// pieces that carry contact, so that either holds the other to account.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "sim/shape/box_tree.h"
#include "sim/shape/interior.h"

namespace tumble {

/// A polyhedron as triangles with a tree of boxes over them, body frame.
class PolygonSoup {
 public:
  /// @param mesh  its solid outlives this
  explicit PolygonSoup(const Mesh& mesh);
  PolygonSoup(const PolygonSoup&) = delete;
  PolygonSoup& operator=(const PolygonSoup&) = delete;

  struct Corners {
    Vec3 at[3];
  };
  const std::vector<Corners>& triangles() const { return triangles_; }
  const BoxTree& tree() const { return tree_; }
  double size() const { return size_; }
  /// A corner of each closed surface that the polyhedron has.
  const std::vector<Vec3>& shells() const { return shells_; }
  /// Whether a body point lies inside.
  bool contains(const Vec3& p_B) const { return inside_.contains(p_B + origin_); }

 private:
  Shape shape_;
  Interior inside_;
  Vec3 origin_;
  std::vector<Corners> triangles_;
  std::vector<Vec3> shells_;
  BoxTree tree_;
  double size_ = 0.0;
};

/// What a look at two polyhedra found.
struct PolygonLook {
  bool apart = true;    ///< a plane parts each pair of polygons, and neither solid is in the other
  double least = 0.0;   ///< [m] of the pairs looked at the least width between their planes; its
                        ///< sign is right if it is no smaller than `bound`
  double bound = 0.0;   ///< [m]
  long pairs = 0;       ///< of polygons whose boxes overlap
  long remembered = 0;  ///< of these, parted by the plane of the look before
  long touching = 0;    ///< of these, that no plane parts
  Survivors boxes;      ///< by level of the trees
};

/// Two polyhedra on their way, with a plane remembered for each pair of polygons that came near.
class PolygonPairs {
 public:
  /// Both outlive this.
  PolygonPairs(const PolygonSoup& a, const PolygonSoup& b) : a_(a), b_(b) {}

  PolygonLook look(const Pose& poseA, const Pose& poseB);

 private:
  const PolygonSoup &a_, &b_;
  std::map<std::pair<int, int>, int> planes_;  ///< number of the axis that parted each pair
};

/// The widest of the planes that two triangles have: along their faces, across pairs of edges and,
/// for triangles in one plane, along their sides.
struct TrianglePlane {
  int axis = -1;
  double gap = 0.0;  ///< [m]; < 0 if none parts them
};
TrianglePlane widestBetween(const PolygonSoup::Corners& a, const PolygonSoup::Corners& b);
/// The gap along one of these axes; −∞ if it has no direction there.
double gapAlong(int axis, const PolygonSoup::Corners& a, const PolygonSoup::Corners& b);

}  // namespace tumble
