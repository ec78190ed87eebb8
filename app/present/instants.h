// Which instants of a run are worth a picture.
#pragma once

#include <vector>

#include "app/record/recording.h"

namespace tumble {

/// Numbers of at most `most` samples, the first and the last of the motion among them, between
/// which the poses change by equal amounts; fewer where the run changes by less. The change of a
/// body from one sample to the next is
///   d = |Δx|/r + |Δα|,   at most 1,
/// with its radius r [m] and the angle Δα [rad] that it turns by; that of the scene √Σ d². What
/// lies at rest for the rest of the run is shown once.
/// @param recording with at least one sample
std::vector<int> tellingSamples(const Scene& scene, const Recording& recording, int most);

}  // namespace tumble
