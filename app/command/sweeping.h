// A sweep: runs, images, table and sheet.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/command/studio.h"

namespace tumble {

struct SweepResult {
  std::vector<std::string> files;  ///< written, or kept
  int code = 0;               ///< kOk, kFailed if a claim does not hold, kPhysics if a run stopped
  int runs = 0, failing = 0;  ///< all, and those of which a claim fails
};

/// Runs the values k with k mod N = I of the scene's sweep, part = (I, N). Into the folder go
/// sweep-<k>/strobe.png for each, a row per value in sweep.csv (sweep-<I>-of-<N>.csv for a part)
/// and, for all values together, sweep.png with the strobes side by side, seen by one camera.
/// @throws SceneError if a value is refused; FileError
SweepResult runSweep(const Scene& scene, const std::string& folder, std::pair<int, int> part,
                     Studio& studio);

}  // namespace tumble
