// What bends: how far from where small steps lead, against the time it takes.
#pragma once

#include "app/report/study.h"

namespace tumble {

/// The scenes of the chapter, by the names of their files in assets/report/parts.
inline constexpr const char* kBendingScenes[] = {"drape", "strip", "cantilever", "jello"};

/// Runs a scene in which something bends by every preset in every step, and once by `exact` in a
/// sixteenth of the least of them. The error of a run is the root of the mean square distance [m]
/// of its points from those of that one, over all samples.
/// @param steps   [s] falling
/// @param budget  [s] of CPU time for the cost of each point
Study bendingStudy(const Scene& scene, const std::vector<double>& steps, double budget);

}  // namespace tumble
