// What `course` remembers from step to step.
#pragma once

#include <map>
#include <utility>

namespace tumble {

/// Whether the contacts of this instant are known, and the events since the last whole step.
struct CourseMemory {
  bool settled = false;
  std::map<std::pair<int, int>, int> recentImpacts;
  int recentBackUps = 0;  ///< stretches that ended before the step did
  int backUpsSpent = 0;   ///< of the store that every whole step refills
  int stalled = 0;        ///< events in a row that moved time by nothing
};

}  // namespace tumble
