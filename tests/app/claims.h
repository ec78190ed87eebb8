// What the tests of all claims ask: does a check hold for a run, and for one that was tampered
// with?
#pragma once

#include <algorithm>
#include <functional>
#include <string>
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

/// Whether the name of a row has this text.
inline bool hasRow(const std::vector<ClaimRow>& rows, const std::string& text) {
  return std::any_of(rows.begin(), rows.end(), [&](const ClaimRow& row) {
    return row.label.find(text) != std::string::npos;
  });
}

}  // namespace tumble
