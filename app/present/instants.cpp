#include "app/present/instants.h"

#include <algorithm>
#include <cmath>

#include "app/claim/free_body.h"

namespace tumble {

namespace {

constexpr double kSeen = 0.05;  // [1] less change than this between two pictures is not seen

double changeBetween(const Scene& scene, const Sample& before, const Sample& after) {
  double sum = 0.0;
  for (std::size_t i = 0; i < after.bodies.size(); ++i) {
    const BodyDef& body = scene.world.bodies[i];
    if (std::holds_alternative<HalfSpace>(body.shape)) continue;
    const double r =
        std::holds_alternative<Particle>(body.shape) ? 1.0 : boundingRadius(body.shape);
    const double d = (after.bodies[i].x - before.bodies[i].x).norm() / r +
                     after.bodies[i].q.angularDistance(before.bodies[i].q);
    sum += std::min(1.0, d * d);
  }
  return std::sqrt(sum);
}

}  // namespace

std::vector<int> tellingSamples(const Scene& scene, const Recording& recording, int most) {
  // How far the run has changed up to each sample.
  const std::vector<Sample>& samples = recording.samples;
  std::vector<double> way(samples.size(), 0.0);
  for (std::size_t k = 1; k < samples.size(); ++k)
    way[k] = way[k - 1] + changeBetween(scene, samples[k - 1], samples[k]);

  const int pictures = std::clamp(1 + static_cast<int>(way.back() / kSeen), 1, most);
  std::vector<int> chosen = {0};
  for (int n = 1; n < pictures; ++n) {
    const double wanted = way.back() * n / (pictures - 1) * (1.0 - 1e-12);
    const auto there = std::lower_bound(way.begin(), way.end(), wanted);
    const int k = static_cast<int>(there - way.begin());
    if (k > chosen.back()) chosen.push_back(k);
  }
  return chosen;
}

}  // namespace tumble
