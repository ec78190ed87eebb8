#include "app/report/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "app/claim/claim.h"
#include "app/record/output.h"
#include "app/report/cost.h"
#include "app/report/nudge.h"

namespace tumble {

namespace {

constexpr int kMembers = 16;  // of the ensemble behind the floor

struct Best {
  Scene held;   ///< of the point with the least error among the methods that step
  Scene flown;  ///< the exact method's, if the chart has it, else the same
};

Best bestOf(const Scene& scene, const ChartDef& chart, const std::vector<ChartSeries>& series) {
  std::optional<Scene> held, exact;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < series.size(); ++i)
    for (std::size_t k = 0; k < series[i].points.size(); ++k) {
      const double error = series[i].points[k].error;
      if (held && exact && !(error < least)) continue;
      Scene point = sceneOf(scene, pointVariant(chart, i, k));
      if (point.world.method == "exact") {
        exact = std::move(point);
      } else if (!held || error < least) {
        least = error;
        held = std::move(point);
      }
    }
  if (!held) held = exact;
  return {*held, exact ? *exact : *held};
}

constexpr double kCoarse = 0.1;   // a larger error does not follow the step any more
constexpr double kBend = 1.5;     // of a curve whose slope changes by more there is no order
constexpr double kReach = 100.0;  // times the least error that a curve has to reach

// The order in the step: slope of error over the chart's number, where the curve is straight.
std::optional<double> stepOrder(const ChartDef& chart, ChartSeries series) {
  if (series.parameter != chart.along.parameter) return {};
  double steepest = -std::numeric_limits<double>::infinity(), flattest = -steepest;
  double least = kCoarse, largest = 0.0;
  const ChartPoint* before = nullptr;
  for (ChartPoint& point : series.points) {
    // As a cost, the number of steps in a second.
    point.cpuShare = 1.0 / std::strtod(point.value.c_str(), nullptr);
    if (!(point.error < kCoarse)) point.error = std::numeric_limits<double>::infinity();
    if (!(point.error < kCoarse && point.error > 100.0 * chart.floor.value_or(0.0))) continue;
    least = std::min(least, point.error);
    largest = std::max(largest, point.error);
    if (before) {
      const double slope =
          std::log(point.error / before->error) / std::log(before->cpuShare / point.cpuShare);
      steepest = std::max(steepest, slope);
      flattest = std::min(flattest, slope);
    }
    before = &point;
  }
  if (steepest - flattest > kBend || largest < kReach * least) return {};
  ChartDef bySteps = chart;
  bySteps.cost = "cpu";
  return observedOrder(bySteps, series);
}

// Refuses a chart without a single such error where its check is named.
void requireError(const Scene& scene, std::size_t index, const std::vector<ChartSeries>& series,
                  bool (*such)(double error), const std::string& otherwise) {
  for (const ChartSeries& one : series)
    for (const ChartPoint& point : one.points)
      if (such(point.error)) return;
  const std::string where = fmt::format("chart[{}].error", index);
  throw SceneError({{scene.places.at(where), where + ": the check '" + scene.charts[index].error +
                                                 "' finds " + otherwise}});
}

}  // namespace

double roundingFloor(const Scene& scene, const Scene& flown, const ChartDef& chart, int members) {
  Random random(scene.seed, "a unit in the last place");
  const double before = largestError(chart, scene, record(flown, scene.image.rate));
  std::vector<double> errors;
  for (int k = 0; k < members; ++k) {
    Scene nudged = flown;
    nudge(nudged.world, random);
    const double after = largestError(chart, scene, record(nudged, scene.image.rate));
    errors.push_back(std::abs(after - before));
  }
  std::nth_element(errors.begin(), errors.begin() + members / 2, errors.end());
  return errors[static_cast<std::size_t>(members / 2)];
}

std::string freeName(const std::string& scene, std::span<const Study> earlier) {
  const auto taken = [&](const std::string& name) {
    return name == "table" || std::any_of(earlier.begin(), earlier.end(),
                                          [&](const Study& study) { return study.name == name; });
  };
  std::string name = scene;
  for (int number = 2; taken(name); ++number) name = scene + "-" + std::to_string(number);
  return name;
}

Study runStudy(const Scene& scene, std::size_t index, double budget, const RunDone& done) {
  Study study;
  study.scene = scene.title;
  study.chapter = scene.chapter;
  study.chart = scene.charts[index];
  study.series = runChart(scene, study.chart, done);
  requireError(
      scene, index, study.series, [](double error) { return std::isfinite(error); },
      "nothing in these runs that it could hold, or they all stop");

  // The floor, by the best method here; the orders above it.
  ChartDef& chart = study.chart;
  if (!chart.floor) {
    const Best best = bestOf(scene, chart, study.series);
    chart.floor = roundingFloor(best.held, best.flown, chart, kMembers);
  }
  for (std::size_t i = 0; i < study.series.size(); ++i) {
    study.orders.push_back(stepOrder(chart, study.series[i]));
    study.methods.push_back(sceneOf(scene, pointVariant(chart, i, 0)).world.method);
    // What a closed form is held to begins anew at each sample; the whole run is no better than
    // its start is known.
    if (study.methods.back() == "exact")
      for (ChartPoint& point : study.series[i].points)
        point.error = std::max(point.error, *chart.floor);
  }
  requireError(
      scene, index, study.series, [](double error) { return std::isfinite(error) && error > 0.0; },
      "no error in these runs, and the axis is logarithmic");
  chart.cost = "cpu";

  // The costs, each from runs of its own.
  std::vector<Scene> scenes;
  for (std::size_t i = 0; i < study.series.size(); ++i)
    for (std::size_t k = 0; k < study.series[i].points.size(); ++k)
      scenes.push_back(sceneOf(scene, pointVariant(chart, i, k)));
  const std::vector<double> shares = cpuShares(scenes, budget);
  std::size_t next = 0;
  for (ChartSeries& series : study.series)
    for (ChartPoint& point : series.points) point.cpuShare = shares[next++];
  return study;
}

std::string studyCsv(const Study& study) {
  std::string csv = "curve,parameter,value,error,evaluations,cpu_seconds_per_second\n";
  for (const ChartSeries& series : study.series)
    for (const ChartPoint& point : series.points)
      csv += fmt::format("{},{},{},{:.17g},{},{:.4g}\n", csvQuoted(series.label), series.parameter,
                         csvQuoted(point.value), point.error, point.evaluations, point.cpuShare);
  return csv;
}

}  // namespace tumble
