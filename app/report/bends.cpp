#include "app/report/bends.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "app/record/recording.h"
#include "app/report/cost.h"
#include "app/report/swarm.h"
#include "sim/problem/problem.h"

namespace tumble {

namespace {

constexpr const char* kPresets[] = {"draft", "fast", "balanced", "exact"};
constexpr double kFiner = 16.0;  // the steps of the run that all are held to

Scene byPreset(const Scene& scene, const char* preset, double step) {
  Scene run = scene;
  run.world.method = "stepping";
  run.world.stepping.take(*findSolverPreset(preset));
  run.world.stepping.step = step;
  return run;
}

// Root of the mean square distance [m] of what bends in two runs; infinite where one has stopped.
double distanceOf(const Scene& scene, const Recording& a, const Recording& b) {
  if (a.samples.size() != b.samples.size() || a.report.stopped || b.report.stopped)
    return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  long count = 0;
  for (std::size_t k = 0; k < a.samples.size(); ++k)
    for (const BentDef& bent : scene.bent)
      for (int i = bent.first; i < bent.first + bent.count; ++i, ++count) {
        const auto body = static_cast<std::size_t>(i);
        sum += (a.samples[k].bodies[body].x - b.samples[k].bodies[body].x).squaredNorm();
      }
  return std::sqrt(sum / static_cast<double>(count));
}

}  // namespace

Study bendingStudy(const Scene& scene, const std::vector<double>& steps, double budget) {
  Study study;
  study.name = "bends-" + scene.name;
  study.scene = scene.title;
  study.chapter = scene.chapter;
  study.chart.variant.title = scene.title;
  study.chart.subtitle = scene.subtitle;
  study.chart.cost = "cpu";
  study.chart.along.parameter = "stepping.step";
  const double rate = scene.image.rate;
  const Recording converged = record(byPreset(scene, "exact", steps.back() / kFiner), rate);
  std::vector<Scene> runs;
  for (const char* preset : kPresets) {
    ChartSeries& series = study.series.emplace_back();
    series.label = preset;
    series.parameter = study.chart.along.parameter;
    std::vector<double> errors;
    for (const double step : steps) {
      runs.push_back(byPreset(scene, preset, step));
      const Recording recording = record(runs.back(), rate);
      errors.push_back(distanceOf(scene, recording, converged));
      series.points.push_back({.value = fmt::format("{:.17g}", step),
                               .error = errors.back(),
                               .evaluations = recording.report.certificate.evaluations});
    }
    study.methods.push_back("stepping");
    study.orders.push_back(steps.size() > 1 ? std::optional(slopeOf(steps, errors)) : std::nullopt);
  }
  const std::vector<double> shares = cpuShares(runs, budget);
  std::size_t next = 0;
  for (ChartSeries& series : study.series)
    for (ChartPoint& point : series.points) point.cpuShare = shares[next++];
  return study;
}

}  // namespace tumble
