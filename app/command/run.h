// Running a scene from the command line.
#pragma once

#include <string_view>

#include "app/record/recording.h"

namespace tumble {

/// Records the scene at the rate [1/s], or at the scene's own if rate is 0, showing progress.
/// @throws SceneError
Recording recordWithProgress(const Scene& scene, double rate = 0.0);

/// The same, but hands on each sample instead of keeping it.
Recording runWithProgress(const Scene& scene, double rate, const std::function<void(Sample&&)>& see,
                          bool timed = false);

/// Notes which keys of [course] and [stepping] say nothing, as `auto` took another method.
/// @param runs the row of the table of methods that is at work
void noteUnused(const Scene& scene, std::string_view runs);

/// Prints what a run spent its time on, if that was counted and there is anything to tell.
void printTimes(const Recording& recording);

/// Prints what the run says of itself, in a few lines.
void printCertificate(const Recording& recording);

/// kOk, or kPhysics after telling why the run stopped.
int exitOf(const Recording& recording);

}  // namespace tumble
