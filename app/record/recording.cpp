#include "app/record/recording.h"

#include <cmath>
#include <ctime>

namespace tumble {

namespace {

// q and −q are one attitude: the sign that lies nearer to the sample before makes it continuous.
void alignSigns(const Sample& before, Sample& sample) {
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    Quat& q = sample.bodies[i].q;
    if (q.dot(before.bodies[i].q) < 0.0) q.coeffs() = -q.coeffs();
  }
}

}  // namespace

World makeWorld(const Scene& scene) {
  try {
    return World(scene.world);
  } catch (const Refusal& refusal) {
    throw SceneError({locate(scene, refusal)});
  }
}

Recording record(const Scene& scene, double rate, const std::function<void(double)>& progress) {
  const std::clock_t start = std::clock();
  World world = makeWorld(scene);
  Recording recording;
  recording.rate = rate;
  recording.features = world.features();

  // One sample each 1/rate, as long as the physics goes on.
  const double duration = scene.world.duration;
  const long last = static_cast<long>(std::floor(duration * rate + 1e-9));
  for (long k = 0; k <= last; ++k) {
    const double t = static_cast<double>(k) / rate;
    world.advance(t);
    if (world.report().stopped) break;
    Sample sample = world.sample(t);
    if (!recording.samples.empty()) alignSigns(recording.samples.back(), sample);
    recording.samples.push_back(std::move(sample));
    if (progress) progress(last == 0 ? 1.0 : static_cast<double>(k) / static_cast<double>(last));
  }

  // The certificate is complete at the end of the duration.
  world.advance(duration);
  recording.report = world.report();
  recording.cpuSeconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return recording;
}

}  // namespace tumble
