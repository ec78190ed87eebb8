// Chapter 9, method: what following a motion closely costs, counted, and what it may cost.
#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "sim/body/rigid_body.h"

namespace tumble {

/// Counted in evaluations of the forces on one body, 1 to 3 µs each; see
/// `tests/bench/sim/auto.cpp`.
struct Effort {
  /// What a contact problem to the last digits costs in these, a body; and one that none of the
  /// solvers solves, whatever its size.
  static constexpr long kPolished = 20, kUnsolved = 500;
  /// Rows of impacts that sweeps go over in the time of one.
  static constexpr long kRows = 20;
  /// n³ over the rows of contacts that are solved for, in the time of one.
  static constexpr double kCubes = 1000.0;

  long most = std::numeric_limits<long>::max();   ///< after which a better method is looked for
  long close = std::numeric_limits<long>::max();  ///< after which joints are followed less closely
  long done = 0;

  bool spent() const { return done >= most; }
  bool hurries() const { return done >= close; }
};

inline long countMoving(std::span<const RigidBody> bodies) {
  return std::count_if(bodies.begin(), bodies.end(),
                       [](const RigidBody& body) { return !body.fixed(); });
}

}  // namespace tumble
