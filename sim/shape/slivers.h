// Chapter 2, shape: pieces in slices, the costly decomposition of slide SH27.
#pragma once

#include <vector>

#include "sim/shape/shape.h"

namespace tumble {

/// Each piece of a mesh once more in up to four slices, across the shortest side of the mesh. A
/// slice flatter than numbers can tell is none.
std::vector<Hull> slivered(const std::vector<Hull>& pieces, const Polyhedron& mesh);

}  // namespace tumble
