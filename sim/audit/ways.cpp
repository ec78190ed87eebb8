#include "sim/audit/ways.h"

#include <algorithm>
#include <utility>

namespace tumble {

void Ways::set(std::span<const ClusterPart> pieces) {
  parts_.clear();
  for (const ClusterPart& piece : pieces)
    for (std::size_t k = 0; k < piece.bodies.size(); ++k)
      parts_.push_back({piece.bodies[k], piece.t0, piece.t1, recordedOf(piece.start[k]),
                        recordedOf(piece.end[k])});
  std::sort(parts_.begin(), parts_.end(), [](const Part& p, const Part& q) {
    return std::pair(p.body, p.t0) < std::pair(q.body, q.t0);
  });
}

std::span<const Ways::Part> Ways::of(int body) const {
  const auto first = std::partition_point(parts_.begin(), parts_.end(),
                                          [&](const Part& part) { return part.body < body; });
  const auto last =
      std::find_if(first, parts_.end(), [&](const Part& part) { return part.body != body; });
  return {first, last};
}

}  // namespace tumble
