// What came of goldens, for programs.
#pragma once

#include <string>
#include <vector>

#include "app/golden/golden.h"

namespace tumble {

/// JUnit's XML: a suite for each folder, a case for each image and table, as CI services read it.
std::string junitXml(const std::vector<Holding>& holdings);

/// The same with every number: {"goldens", "pass", "exact", "folders": [{"folder", "environment",
/// "findings": [{"subject", "name", "kind", "passes", "exact", "verdict", …}]}]}. Of an image
/// "share", "mean" and "largest" as in ImageDifference; of numbers "worst", null if the shape
/// differs, and "where".
std::string goldenJson(const std::vector<Holding>& holdings);

}  // namespace tumble
