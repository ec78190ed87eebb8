// Chapter 3, body: points spread over a box, three ways (slide SF26).
#pragma once

#include <cstdint>
#include <vector>

#include "sim/shape/shape.h"

namespace tumble {

/// How points fill a box of volume B. With N of them, a share of a smooth solid is found to within
///   Grid    N^(−2/3): only the N^(2/3) cells at the surface err, and no two alike; N^(−1/3) where
///           whole faces lie along the cells and err alike
///   Random  N^(−1/2), standard deviation √(V (B − V)/N) of the volume V
///   Quasi   at best N^(−1) log³ N, for boxes along the axes (Halton 1960; Niederreiter 1992,
///   §2.2);
///           about N^(−2/3) for tilted and curved surfaces
enum class Spread { Grid, Random, Quasi };

/// The points of a spread over a box.
class Samples {
 public:
  /// @param count  of points wanted, 1 or more; a grid of nearly cubic cells takes the nearest
  /// number
  /// @param seed   of random points; each seed has points of its own
  Samples(Spread spread, const Aabb& box, int count, std::uint64_t seed = 0);

  int count() const { return count_; }
  /// Point i in [0, count()) [m]: the middle of cell i; a draw; Halton's point i in bases 2, 3, 5.
  Vec3 operator[](int i) const;

 private:
  Spread spread_;
  Aabb box_;
  int count_;
  std::uint64_t seed_;
  int cells_[3] = {1, 1, 1};
};

/// The points of a spread over the box of a shape that lie inside it, body frame [m].
std::vector<Vec3> pointsInside(const Shape& shape, Spread spread, int count,
                               std::uint64_t seed = 0);

}  // namespace tumble
