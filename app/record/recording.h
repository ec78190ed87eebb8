// A run written down: samples, events, certificate.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/scene/scene.h"
#include "sim/world.h"

namespace tumble {

struct Recording {
  std::vector<Sample> samples;  ///< at k/rate, k = 0 … sampleCount − 1
  std::optional<Sample> end;    ///< of the duration, if the last sample lies before it
  Report report;
  std::vector<std::string> features;
  std::string method;  ///< World::method at the end
  std::string runs;    ///< World::runs at the end
  double rate = 60.0;  ///< [1/s]
  double cpuSeconds = 0.0;
  StageTimes times;  ///< if they are counted
};

/// The scene's world at the start.
/// @throws SceneError if the world refuses the scene, placed where the scene says it.
World makeWorld(const Scene& scene);

/// Samples of a run of that length: floor(duration·rate + 1e-9) + 1.
/// @throws SceneError if they are more than fit in memory or on a disk: above a million, or above
/// 20 million bodies in all samples together (3 GB).
int sampleCount(const Scene& scene, double rate);

/// Runs the scene's world from start to duration and shows each sample as soon as it is known; the
/// recording that is returned keeps the end alone, and where the time went, if that is wanted.
/// `progress` is told the share done in [0, 1].
/// @throws SceneError if the world refuses the scene.
Recording run(const Scene& scene, double rate, const std::function<void(Sample&&)>& see,
              const std::function<void(double)>& progress = {}, bool timed = false);

/// Runs the scene's world from start to duration. `progress` is told the share done in [0, 1].
/// A run that stopped early has fewer samples and says so in its report.
/// @throws SceneError if the world refuses the scene, or for too many samples.
Recording record(const Scene& scene, double rate, const std::function<void(double)>& progress = {});

/// The scene with the method that was at work at the end, for claims that ask which it was.
Scene asRun(const Scene& scene, const Recording& recording);

/// A run that stopped before there was anything to show: exit 6.
class StoppedError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace tumble
