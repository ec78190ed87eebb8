// Chapter 6, problem: a contact problem laid out for sweeps over its cones. Used by pgs.cpp alone.
#pragma once

#include <vector>

#include "sim/problem/problem.h"
#include "sim/problem/swept_cone.h"

namespace tumble {

/// Sweeps over the cones of a problem in their order, to the last bit: only what moves no body in
/// common changes places, to go side by side in two lanes.
class ConeSweeps {
 public:
  void prepare(const Problem& problem);

  /// y = Kᵀ λ, with y and K as in swept_cone.h.
  void take(const VecX& lambda);
  /// Solves cone after cone for its own λ, all others kept, forwards or backwards. Returns the
  /// largest change of λ in units of u.
  double pass(bool forwards, VecX& lambda);

  /// Per row: diagonal entry of W, or 1 if that is 0.
  const VecX& mobility() const { return mobility_; }

 private:
  /// Cones in a row between the same two bodies.
  struct Run {
    int a, b;
    int first, count;  ///< cones
    int depth;         ///< length of the longest chain of runs that it waits for
    bool friction;     ///< contacts with friction only
  };
  /// A run alone, or two of one depth side by side.
  struct Place {
    bool twins;
    int first, count;  ///< of cones_, or of twins_
    TwinBodies bodies;
  };

  void layOut(const Problem& problem, const Cone& from, SweptCone& cone);
  void findRuns(const Problem& problem);
  void pair(const Problem& problem);

  std::vector<SweptCone> cones_;
  std::vector<Run> runs_;   ///< by depth
  std::vector<int> depth_;  ///< per body: of its last run
  std::vector<Place> places_;
  std::vector<TwinCone> twins_;
  std::vector<Mat3> roots_;  ///< per body: lower triangle with B = (√invM, root)
  std::vector<Vec6> y_;
  VecX mobility_;
};

}  // namespace tumble
