// What the tests of all claims ask: does a check hold for a run, and for one that was tampered
// with?
#pragma once

#include <functional>
#include <vector>

#include "app/claim/claim.h"
#include "tests/catch.h"

namespace tumble {

inline bool holds(const char* check, const Scene& scene, const Recording& recording) {
  const std::vector<ClaimRow> rows = findCheck(check)->rows(scene, recording);
  bool all = !rows.empty();
  for (const ClaimRow& row : rows) {
    UNSCOPED_INFO(row.label << ": " << row.measured << ", " << row.exact << ", error " << row.error
                            << ", allowed " << row.allowed);
    all = all && row.holds();
  }
  return all;
}

inline bool holdsBroken(const char* check, const Scene& scene, Recording recording,
                        const std::function<void(Recording&)>& breakIt) {
  breakIt(recording);
  return holds(check, scene, recording);
}

}  // namespace tumble
