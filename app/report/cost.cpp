#include "app/report/cost.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "app/record/recording.h"

namespace tumble {

namespace {

constexpr int kTurns = 5;
constexpr double kBatch = 1e-3;     // [s] that a reading of the clock should cover
constexpr int kLargestBatch = 500;  // worlds alive at once

// CPU time [s] of one run out of a batch.
double timeBatch(const Scene& scene, int count) {
  std::vector<World> worlds;
  worlds.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) worlds.push_back(makeWorld(scene));
  const double duration = scene.world.duration;
  const double start = processSeconds();
  for (World& world : worlds) {
    world.advance(duration);
    world.sample(duration);
  }
  return (processSeconds() - start) / count;
}

// One scene's share of the work.
struct Job {
  const Scene& scene;
  int batch = 1;
  double spent = 0.0;  // [s]
  double least = std::numeric_limits<double>::infinity();

  void run(int count) {
    const double each = timeBatch(scene, count);
    spent += each * count;
    least = std::min(least, each);
  }
  // A fifth of the budget, unless it is spent already.
  void turn(double budget) {
    const double end = spent + budget / kTurns;
    if (spent >= budget) return;
    do run(batch);
    while (spent < end);
  }
};

}  // namespace

double processSeconds() {
  std::timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<double> cpuShares(const std::vector<Scene>& scenes, double budget) {
  std::vector<Job> jobs;
  for (const Scene& scene : scenes) {
    Job& job = jobs.emplace_back(Job{scene});
    job.run(1);
    job.batch = std::clamp(static_cast<int>(std::ceil(kBatch / job.least)), 1, kLargestBatch);
  }
  for (int k = 0; k < kTurns; ++k)
    for (Job& job : jobs) job.turn(budget);
  std::vector<double> shares;
  for (const Job& job : jobs) shares.push_back(job.least / job.scene.world.duration);
  return shares;
}

}  // namespace tumble
