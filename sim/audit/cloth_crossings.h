// Chapter 10, audit: where cloth passes through itself or through other cloth.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "sim/audit/recorded.h"
#include "sim/method/model.h"
#include "sim/shape/box_tree.h"

namespace tumble {

/// All cloths of a model as one set of edges and triangles.
class ClothCrossings {
 public:
  explicit ClothCrossings(const Model& model);

  bool any() const { return !triangles_.empty(); }

  /// How many pairs of an edge and a triangle there are of which the edge passes through the
  /// inside of the triangle, decided exactly (`pierces`).
  long count(std::span<const Recorded> states) const;

 private:
  std::vector<std::array<int, 3>> triangles_;  ///< by numbers of bodies
  std::vector<std::pair<int, int>> edges_;
  BoxTree tree_;  ///< of triangles as they were at the start
};

}  // namespace tumble
