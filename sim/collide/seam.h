// Chapter 5, collide: the parts of one body are one solid. What a part shows where another part of
// its body covers it is no surface, and nothing touches it there.
//
// A contact normal lies in the normal cone of the solid's feature. On a convex part B of the body
// that cone is known; of the solid, at a point q,
//   n is normal  ⇔  no other part that holds q rises above the plane through q square to n.
// A contact is one of the solid's if such q lie within a small reach of it on the feature that B
// shows along n: the face beside a wall that stands on it is a surface, the face inside a seam and
// the edges about it are none, whether edges match or not.
#pragma once

#include "sim/collide/contact_point.h"
#include "sim/collide/parts.h"

namespace tumble {

/// Whether the surface of a part is the surface of the body at p [m] along the unit vector n, both
/// in the body frame; `edge` is the direction of the edge that p lies on, or 0. Looks as far as
/// `within` [m] from p, or the small reach if that is more.
bool isExposed(const Parts& parts, int part, const Vec3& p, const Vec3& n, const Vec3& edge,
               double within = 0.0);

/// What is left of the points of two parts without those that are no contact of the solids.
enum class Left : std::uint8_t {
  Enough,
  NotDeepest,  ///< the deepest of an overlap went
  NotNearest,  ///< the nearest of a gap went
};

/// Takes away the points from `first` on that are no contact of the two solids, or no corner of
/// what they share: those between part i of a and part j of b. Of the latter something is always
/// left.
Left leaveCovered(const PartView& a, int i, const PartView& b, int j, std::size_t first,
                  Manifold& out);

/// Takes away the points of balls and capsules on edges that a face beside them is flush with,
/// where that face has a point: the normal leans too little for an edge within the face to tell.
void leaveBeside(const PartView& a, const PartView& b, Manifold& out);

/// What contact of the solids is looked for, [m].
struct Sought {
  double margin = 0.0;   ///< no wider apart
  double deepest = 0.0;  ///< no deeper
  double within = 0.0;   ///< a feature shows there if it does so as near as this
  bool apart = false;    ///< of parts that are apart: no more than on the way to each other
};

/// Adds the points along the widest plane on which features of part i of a and part j of b meet
/// that show on the solids; none if there is no such plane.
void findExposed(const PartView& a, int i, const PartView& b, int j, const Sought& sought,
                 Manifold& out);

}  // namespace tumble
