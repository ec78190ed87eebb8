#include "app/record/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "app/record/threads.h"

namespace tumble {

namespace {

constexpr double kMostSamples = 1e6;       // image-000000.png … image-999999.png
constexpr double kMostBodySamples = 20e6;  // of 150 bytes

// q and −q are one attitude: the sign that lies nearer to the sample before makes it continuous.
class Signs {
 public:
  void align(Sample& sample) {
    for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
      Quat& q = sample.bodies[i].q;
      if (i == before_.size())
        before_.push_back(q);
      else if (q.dot(before_[i]) < 0.0)
        q.coeffs() = -q.coeffs();
      before_[i] = q;
    }
  }

 private:
  std::vector<Quat> before_;
};

}  // namespace

World makeWorld(const Scene& scene) {
  try {
    World world(scene.world);
    world.lend(makeWorkers(threadsInUse()));
    return world;
  } catch (const Refusal& refusal) {
    throw SceneError({locate(scene, refusal)});
  }
}

int sampleCount(const Scene& scene, double rate) {
  const double count = std::floor(scene.world.duration * rate + 1e-9) + 1.0;
  const double bodies = static_cast<double>(scene.world.bodies.size());
  const double most = std::min(kMostSamples, std::floor(kMostBodySamples / std::max(bodies, 1.0)));
  if (count <= most) return static_cast<int>(count);
  throw SceneError(
      {{{scene.file},
        fmt::format("world.duration: {:g} s at {:g} samples a second are {:.0f} "
                    "samples, and {} bodies allow {:.0f}; take a shorter duration, "
                    "or a lower image.rate or --rate",
                    scene.world.duration, rate, count, scene.world.bodies.size(), most)}});
}

Recording run(const Scene& scene, double rate, const std::function<void(Sample&&)>& see,
              const std::function<void(double)>& progress, bool timed) {
  std::clock_t start = std::clock();
  World world = makeWorld(scene);
  if (timed)
    world.countTime([] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
          .count();
    });
  Recording recording;
  recording.rate = rate;
  recording.features = world.features();

  // One sample each 1/rate, as long as the physics goes on.
  Signs signs;
  const int last = sampleCount(scene, rate) - 1;
  for (int k = 0; k <= last; ++k) {
    const double t = static_cast<double>(k) / rate;
    world.advance(t);
    if (world.report().stopped) break;
    Sample sample = world.sample(t);
    signs.align(sample);
    const std::clock_t known = std::clock();
    see(std::move(sample));
    start += std::clock() - known;  // what is done with samples is not the run's own time
    if (progress) progress(last == 0 ? 1.0 : static_cast<double>(k) / last);
  }

  // The certificate is complete at the end of the duration.
  world.advance(scene.world.duration);
  recording.report = world.report();
  if (!recording.report.stopped && !isSample(scene.world.duration, rate)) {
    recording.end = world.sample(scene.world.duration);
    signs.align(*recording.end);
  }
  recording.times = world.times();
  recording.method = world.method();
  recording.runs = world.runs();
  recording.cpuSeconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return recording;
}

Recording record(const Scene& scene, double rate, const std::function<void(double)>& progress) {
  std::vector<Sample> samples;
  Recording recording = run(
      scene, rate, [&](Sample&& sample) { samples.push_back(std::move(sample)); }, progress);
  recording.samples = std::move(samples);
  return recording;
}

Scene asRun(const Scene& scene, const Recording& recording) {
  Scene ran = scene;
  if (!recording.runs.empty()) ran.world.method = recording.runs;
  return ran;
}

}  // namespace tumble
