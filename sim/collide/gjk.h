// Chapter 5, collide: how far two convex solids are apart, asked of their outermost points alone.
#pragma once

#include <algorithm>
#include <limits>

#include "sim/math/vec.h"

namespace tumble::gjk {

/// Outermost points of two solids, and the numbers of the vertices they are; −1 on curved surfaces.
struct Outermost {
  Vec3 a, b;  ///< [m]
  int ia = -1, ib = -1;
};

/// A corner of the difference a − b.
struct Corner : Outermost {
  Vec3 w;               ///< [m] a − b
  double weight = 1.0;  ///< share in the nearest point
};

/// At most four corners, kept as long as they carry the nearest point.
struct Simplex {
  Corner corner[4];
  int count = 0;
};

/// The point of the simplex nearest to the origin [m], of those that its last corner carries: it
/// lies beyond the point nearest so far. Drops the corners that do not carry it; four are left if
/// the origin is between them.
Vec3 nearestOf(Simplex& simplex);

/// What the search leaves behind.
struct Nearest {
  Simplex simplex;
  Vec3 v = Vec3::Zero();  ///< [m] from b to a, between nearest points
  double lower = -std::numeric_limits<double>::infinity();  ///< [m] widest slab seen on the way
  bool inside = false;                                      ///< no plane parts the two
};

/// The point of the difference a − b that is nearest to the origin, from at most four of its
/// outermost points at a time. Gilbert, Johnson and Keerthi, "A fast procedure for computing the
/// distance between complex objects in three-dimensional space", 1988.
/// @param outermost  (n) → Outermost: of a along −n, of b along n
/// @param v          where to look first, any vector but zero
/// @param rounding   [m] distances below it are zero, and differences below it no progress
/// @param enough     [m] ends as soon as a slab is wider than this
template <class Support>
Nearest nearest(Support outermost, Vec3 v, double rounding,
                double enough = std::numeric_limits<double>::infinity()) {
  constexpr int kMostSteps = 128;
  Nearest out;
  double length = v.norm();
  for (int step = 0; step < kMostSteps; ++step) {
    const Corner corner = [&] {
      Corner c{outermost(v), Vec3::Zero()};
      c.w = c.a - c.b;
      return c;
    }();
    out.lower = std::max(out.lower, v.dot(corner.w) / length);
    if (out.lower > enough) break;
    if (step > 0) {
      if (length - out.lower <= rounding) break;
      const auto known = [&](const Corner& c) { return c.w == corner.w; };
      if (std::any_of(out.simplex.corner, out.simplex.corner + out.simplex.count, known)) break;
    }
    Simplex grown = out.simplex;
    grown.corner[grown.count++] = corner;
    const Vec3 nearer = nearestOf(grown);
    const double shorter = nearer.norm();
    if (step > 0 && shorter >= length) break;
    out.simplex = grown;
    out.v = v = nearer;
    length = shorter;
    out.inside = grown.count == 4 || length <= rounding;
    if (out.inside) break;
  }
  return out;
}

}  // namespace tumble::gjk
