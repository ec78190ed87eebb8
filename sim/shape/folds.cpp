#include "sim/shape/folds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sim/math/orientation.h"

namespace tumble::cut {
namespace {

/// Triangles of one plane that hang together by edges and face the same way.
struct Patch {
  int side;                         ///< −1 if they face up
  double area = 0.0;                ///< [m²] twice
  std::vector<std::size_t> folded;  ///< patches that face the other way, across an edge
  bool settled = false;
};

class Patches {
 public:
  Patches(const Points& points, const Surface& triangles, const Vec3& n) : triangles_(triangles) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& corner = triangles[t].corner;
      const auto at = [&](std::size_t k) { return points.at[static_cast<std::size_t>(corner[k])]; };
      up_.push_back(twiceArea(at(0), at(1), at(2)).dot(n));
      for (std::size_t k = 0; k < 3; ++k) left_[{corner[k], corner[(k + 1) % 3]}] = t;
    }
    patchOf_.assign(triangles.size(), triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (patchOf_[t] == triangles.size()) grow(t);
    for (std::size_t t = 0; t < triangles.size(); ++t)
      forNeighbours(t, [&](std::size_t other) {
        if (patchOf_[other] != patchOf_[t]) patches_[patchOf_[t]].folded.push_back(patchOf_[other]);
      });
  }

  std::vector<int> sides() {
    std::vector<std::size_t> order;
    for (std::size_t p = 0; p < patches_.size(); ++p) order.push_back(p);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) {
      return patches_[p].area > patches_[q].area;
    });
    for (const std::size_t p : order) {
      patches_[p].settled = true;
      for (const std::size_t other : patches_[p].folded)
        if (!std::exchange(patches_[other].settled, true)) patches_[other].side = patches_[p].side;
    }
    std::vector<int> sides;
    for (const std::size_t p : patchOf_) sides.push_back(patches_[p].side);
    return sides;
  }

 private:
  template <class Visit>
  void forNeighbours(std::size_t t, Visit visit) const {
    const auto& corner = triangles_[t].corner;
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto other = left_.find({corner[(k + 1) % 3], corner[k]}); other != left_.end())
        visit(other->second);
  }

  void grow(std::size_t seed) {
    std::vector<std::size_t> found = {seed};
    patchOf_[seed] = patches_.size();
    Patch patch;
    patch.side = up_[seed] > 0.0 ? -1 : 1;
    for (std::size_t next = 0; next < found.size(); ++next) {
      patch.area += std::abs(up_[found[next]]);
      forNeighbours(found[next], [&](std::size_t other) {
        if (patchOf_[other] < triangles_.size() || (up_[other] > 0.0) != (up_[seed] > 0.0)) return;
        patchOf_[other] = patches_.size();
        found.push_back(other);
      });
    }
    patches_.push_back(std::move(patch));
  }

  const Surface& triangles_;
  std::vector<double> up_;                           // [m²] twice the area, < 0 if it faces down
  std::map<std::pair<int, int>, std::size_t> left_;  // of an edge
  std::vector<std::size_t> patchOf_;
  std::vector<Patch> patches_;
};

}  // namespace

std::vector<int> sidesWithin(const Points& points, const Surface& triangles, const Vec3& n) {
  return Patches(points, triangles, n).sides();
}

}  // namespace tumble::cut
