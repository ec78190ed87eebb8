// A chart of a scene: its runs, their numbers, and the plot of them.
#pragma once

#include "app/panel/variant_run.h"
#include "render/chart.h"

namespace tumble {

/// One run of a chart.
struct ChartPoint {
  std::string value;   ///< of the chart's key, as TOML
  double error = 0.0;  ///< largest of the check's rows; infinite where the physics could not go on
  long evaluations = 0;   ///< of derivatives
  double cpuShare = 0.0;  ///< CPU seconds for each simulated second
};

struct ChartSeries {
  std::string label;
  std::string parameter;  ///< key that the points differ in
  std::vector<ChartPoint> points;
};

/// What is changed for one point of a curve.
Variant pointVariant(const ChartDef& chart, std::size_t curve, std::size_t point);

/// The largest error among the rows of the chart's check that it is about; infinite without one.
double largestError(const ChartDef& chart, const Scene& scene, const Recording& recording);

/// Runs every value of every curve. @throws SceneError
std::vector<ChartSeries> runChart(const Scene& scene, const ChartDef& chart, const RunDone& done);

/// Order of the errors: slope of log error over the log of the chart's key, where its values are
/// numbers, else of the cost, without its sign; least squares over the points on the straight part:
/// error < 0.1, where the first term leads, and > 100 floor, where rounding has no part; no dearer
/// than the least error. Nothing with fewer than three such points, nor along a key of its own.
std::optional<double> observedOrder(const ChartDef& chart, const ChartSeries& series);

/// Header and a row for each run: curve, parameter, value, error, evaluations – numbers that are
/// the same on every machine.
std::string chartCsv(const std::vector<ChartSeries>& series);

/// The plot: error to the right, cost upwards, both logarithmic, with the order behind each label.
Chart chartOf(const ChartDef& chart, const std::vector<ChartSeries>& series);

}  // namespace tumble
