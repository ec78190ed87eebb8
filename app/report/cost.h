// What a run costs: CPU time, measured apart from everything else.
#pragma once

#include <vector>

#include "app/scene/scene.h"

namespace tumble {

/// CPU time [s] that this process has used.
double processSeconds();

/// Measures how many CPU seconds each scene takes for a simulated second: from the start to the end
/// of the duration and one look at it, worlds made beforehand, nothing recorded. The scenes take
/// turns, so that a machine that slows down does so for all; of each the least is kept, since noise
/// only adds.
/// @param budget  [s] spent on each scene, in five turns; a scene that takes longer runs once
std::vector<double> cpuShares(const std::vector<Scene>& scenes, double budget);

}  // namespace tumble
