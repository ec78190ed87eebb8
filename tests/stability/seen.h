// A scene as seen from elsewhere: turned, mirrored, shifted, its bodies in another order. The same
// motion, in other numbers.
#pragma once

#include <vector>

#include "sim/world.h"

namespace tumble::test {

/// World points go to  turn p + shift;  body i of the scene seen is body order[i] of the scene.
struct Seen {
  Mat3 turn = Mat3::Identity();  ///< orthogonal; det −1 mirrors
  Vec3 shift = Vec3::Zero();     ///< [m]
  std::vector<int> order = {};   ///< empty: as it is

  bool mirrors() const { return turn.determinant() < 0.0; }
  int bodyAt(int i) const { return order.empty() ? i : order[static_cast<std::size_t>(i)]; }
};

/// The scene as it looks from there. Bodies that are mirrored are so across their own x = 0.
WorldDef seenFrom(const Seen& seen, const WorldDef& def);

/// What was seen of a body of the scene, in the numbers of the scene itself.
BodySample asItIs(const Seen& seen, const BodySample& body);

}  // namespace tumble::test
