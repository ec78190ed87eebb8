#include "sim/collide/sweep.h"

#include <algorithm>
#include <numeric>

namespace tumble {

std::optional<SweepCount> sweepPairs(std::span<const Aabb> boxes, const SweepCount& most,
                                     std::vector<std::pair<int, int>>& pairs) {
  std::vector<int> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    const double p = boxes[i].lo.x(), q = boxes[j].lo.x();
    return p < q || (p == q && i < j);
  });

  pairs.clear();
  SweepCount count;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Aabb& box = boxes[order[k]];
    for (std::size_t l = k + 1; l < order.size(); ++l) {
      const Aabb& other = boxes[order[l]];
      if (other.lo.x() > box.hi.x()) break;
      if (++count.comparisons > most.comparisons) return std::nullopt;
      if (!box.overlaps(other)) continue;
      if (++count.pairs > most.pairs) return std::nullopt;
      pairs.push_back(std::minmax(order[k], order[l]));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return count;
}

}  // namespace tumble
