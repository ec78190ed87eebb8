// Chapter 5, collide: the convex parts of a body, made ready once, and the one door to pairs of
// them.
#pragma once

#include <memory>
#include <vector>

#include "sim/shape/box_tree.h"
#include "sim/shape/shape.h"

namespace tumble {

/// What a compound is the union of, in its body frame, to be asked without copying.
struct Parts {
  std::vector<PosedPart> list;
  BoxTree tree;
  /// Of each part, the others that it touches: what they cover is no surface of the body.
  std::vector<std::vector<int>> beside;
  std::vector<double> size;    ///< [m] of each part: the half of its box's longest edge
  std::vector<double> radius;  ///< [m] of each part, about its own origin
  std::vector<int> leaf;       ///< of each part, its box in the tree
  double flush = 0.0;          ///< [m] parts no further apart touch; steps no higher are none
  double level = 0.0;          ///< [m] the same of parts that fill the body to rounding
};

/// The largest number of parts of one body: features have no room to name more.
inline constexpr std::size_t kMostParts = 4095;

Parts partsOf(const Compound& compound);

/// A shape as a world keeps it: compounds with their parts ready. Others stay as they are.
Shape readyShape(Shape shape);

/// One side of a query: a shape that is convex, or the parts of a compound.
class PartView {
 public:
  /// The shape must outlive it.
  PartView(const Shape& shape, const Pose& pose);

  const Parts* parts() const { return parts_; }
  const Pose& pose() const { return pose_; }
  const Shape& solid(int part) const {
    return parts_ ? parts_->list[static_cast<std::size_t>(part)].solid : shape_;
  }
  Pose poseOf(int part) const;
  const BoxTree& tree() const { return *tree_; }
  /// [m], of a part about its own origin.
  double radiusOf(int part) const {
    return parts_ ? parts_->radius[static_cast<std::size_t>(part)] : boundingRadius(shape_);
  }
  /// The box of a part in the tree.
  int leafOf(int part) const { return parts_ ? parts_->leaf[static_cast<std::size_t>(part)] : 0; }
  const HalfSpace* plane() const { return std::get_if<HalfSpace>(&shape_); }

 private:
  const Shape& shape_;
  Pose pose_;
  std::shared_ptr<const Parts> own_;  // of a compound that is not ready
  const Parts* parts_ = nullptr;
  BoxTree single_;
  const BoxTree* tree_ = nullptr;
};

/// Calls visit(part of a, part of b) for the pairs of parts whose boxes are within `reach` [m] of
/// each other; visit may shorten it. A shape that is no compound is one part, number 0. What is
/// below a pair of boxes of which skip(index of a, index of b) holds is passed over.
template <class Visit, class Skip = tree::NoSkip>
void forNearParts(const PartView& a, const PartView& b, const double& reach, const Visit& visit,
                  Survivors* count = nullptr, const Skip& skip = {}) {
  if (a.plane() || b.plane()) {
    const PartView& solid = a.plane() ? b : a;
    const HalfSpace& plane = a.plane() ? *a.plane() : *b.plane();
    const int parts = solid.parts() ? static_cast<int>(solid.parts()->list.size()) : 1;
    for (int k = 0; k < parts; ++k) {
      const Pose at = solid.poseOf(k);
      if (plane.n.dot(at.x) - plane.d - solid.radiusOf(k) > reach) continue;
      a.plane() ? visit(0, k) : visit(k, 0);
    }
    return;
  }
  forNear(a.tree(), b.tree(), seatOf(a.pose(), b.pose()), reach, visit, count, skip);
}

}  // namespace tumble
