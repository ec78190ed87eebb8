// Chapter 5, collide: coherence where no plane parts two bodies, as one reaches around the other
// (slides SH28, SD40). A plane parts one part from another, and, as a rule, their neighbours too:
// it is kept for boxes of the trees as high up as it parts all parts below them.
#pragma once

#include <span>
#include <vector>

#include "sim/collide/collide.h"
#include "sim/collide/parts.h"
#include "sim/collide/witness.h"

namespace tumble {

/// The planes between boxes of two bodies' trees that hold at one pose. Neither body is a
/// half-space. Views and counts outlive it.
class PartPlanes {
 public:
  PartPlanes(const PartView& a, const PartView& b, double margin, std::vector<PartWitness>& held,
             PartLooks& looks)
      : a_(a),
        b_(b),
        seat_(seatOf(a.pose(), b.pose())),
        margin_(margin),
        held_(held),
        looks_(looks) {
    held_.clear();
  }

  /// Those of the planes known before that part their boxes by more than the margin. One that does
  /// not is asked of the boxes below.
  void keep(std::span<const PartWitness> known);
  /// Whether one was kept for this pair of boxes.
  bool keeps(int i, int j) const;
  /// Whether one that was found since parts this pair of parts.
  bool hasFound(int partA, int partB) const;
  /// A plane found between two parts, raised as high as it parts all below.
  void find(int partA, int partB, const Witness& plane);

 private:
  bool isNear(int i, int j) const;
  void ask(int i, int j, const Witness& plane);
  bool parts(int i, int j, const Witness& plane) const;
  bool isUnder(const PartWitness& held, int i, int j) const;
  PartWitness above(int i, int j, const Witness& plane) const;

  const PartView &a_, &b_;
  Seat seat_;
  double margin_;
  std::vector<PartWitness>& held_;  // the first `kept_` of them in order
  std::size_t kept_ = 0;
  PartLooks& looks_;
};

}  // namespace tumble
