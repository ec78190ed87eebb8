// Chapter 10, audit: where cloth passes through itself or through other cloth.
#pragma once

#include <array>
#include <span>
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
  class Count;
  struct Triangle {
    std::array<int, 3> corners = {};  ///< by numbers of bodies
    std::array<bool, 3> owns = {};    ///< of edges, which are each the first triangle's that has it
  };
  std::vector<Triangle> triangles_;
  BoxTree tree_;  ///< of triangles as they were at the start
};

}  // namespace tumble
