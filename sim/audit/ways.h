// Chapter 10, audit: the parts of a step that only some bodies have.
#pragma once

#include <span>
#include <vector>

#include "sim/audit/recorded.h"
#include "sim/method/state.h"

namespace tumble {

/// Where a method divided a step for some bodies alone: each of them with a state at both ends of
/// every part. World frame, SI.
class Ways {
 public:
  /// One body in one part.
  struct Part {
    int body = 0;
    double t0 = 0.0, t1 = 0.0;  ///< [s]
    Recorded start, end;
  };

  /// The parts of another step.
  void set(std::span<const ClusterPart> pieces);

  /// Those of one body in the order of time; none if it took the step whole.
  std::span<const Part> of(int body) const;

 private:
  std::vector<Part> parts_;  ///< by body, then by time
};

}  // namespace tumble
