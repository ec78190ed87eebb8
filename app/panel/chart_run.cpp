#include "app/panel/chart_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/claim/claim.h"
#include "app/present/palette.h"
#include "app/record/output.h"

namespace tumble {

namespace {

constexpr double kClear = 100.0;  // times the floor: what rounding adds is less than a percent

double costOf(const ChartDef& chart, const ChartPoint& point) {
  return chart.cost == "cpu" ? point.cpuShare : static_cast<double>(point.evaluations);
}

ChartPoint runPoint(const Scene& scene, const ChartDef& chart, const Variant& variant) {
  const Scene changed = sceneOf(scene, variant);
  const Recording recording = record(changed, changed.image.rate);
  ChartPoint point;
  point.error = recording.report.stopped ? std::numeric_limits<double>::infinity()
                                         : largestError(chart.error, changed, recording);
  point.evaluations = recording.report.certificate.evaluations;
  point.cpuShare = recording.cpuSeconds / changed.world.duration;
  return point;
}

// The values that a curve is run for.
const std::vector<std::string>& valuesOf(const ChartDef& chart, const CurveDef& curve) {
  return curve.values.empty() ? chart.along.values : curve.values;
}

}  // namespace

double largestError(const std::string& check, const Scene& scene, const Recording& recording) {
  double largest = 0.0;
  for (const ClaimRow& row : findCheck(check)->rows(scene, recording))
    largest = std::isnan(row.error) ? row.error : std::max(largest, row.error);
  return largest;
}

Variant pointVariant(const ChartDef& chart, std::size_t curve, std::size_t point) {
  const CurveDef& def = chart.curves[curve];
  Sweep along = chart.along;
  along.values = valuesOf(chart, def);
  Variant variant = joined(chart.variant, def.variant);
  variant.set.push_back(along.setting(point));
  return variant;
}

std::vector<ChartSeries> runChart(const Scene& scene, const ChartDef& chart, const RunDone& done) {
  std::vector<ChartSeries> all;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const std::vector<std::string>& values = valuesOf(chart, chart.curves[i]);
    ChartSeries& series = all.emplace_back();
    series.label = chart.curves[i].variant.title;
    for (std::size_t k = 0; k < values.size(); ++k) {
      series.points.push_back(runPoint(scene, chart, pointVariant(chart, i, k)));
      series.points.back().value = values[k];
      done();
    }
  }
  return all;
}

std::optional<double> observedOrder(const ChartDef& chart, const ChartSeries& series) {
  const double floor = chart.floor.value_or(0.0);
  double least = std::numeric_limits<double>::infinity(), costOfLeast = 0.0;
  for (const ChartPoint& point : series.points)
    if (point.error < least) {
      least = point.error;
      costOfLeast = costOf(chart, point);
    }
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const ChartPoint& point : series.points) {
    const double cost = costOf(chart, point);
    if (!std::isfinite(point.error) || point.error <= kClear * floor || !(cost > 0.0) ||
        cost > costOfLeast)
      continue;
    const double x = std::log10(cost), y = std::log10(point.error);
    n += 1.0;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const double spread = n * sxx - sx * sx;
  if (n < 3.0 || !(spread > 0.0)) return {};
  return -(n * sxy - sx * sy) / spread;
}

std::string chartCsv(const ChartDef& chart, const std::vector<ChartSeries>& series) {
  std::string csv = "curve,parameter,value,error,evaluations\n";
  for (const ChartSeries& one : series)
    for (const ChartPoint& point : one.points)
      csv += fmt::format("{},{},{},{:.17g},{}\n", csvQuoted(one.label), chart.along.parameter,
                         csvQuoted(point.value), point.error, point.evaluations);
  return csv;
}

Chart chartOf(const ChartDef& chart, const std::vector<ChartSeries>& series) {
  Chart plot;
  plot.title = chart.variant.title;
  plot.subtitle = chart.subtitle;
  plot.x = {"error", true};
  plot.y = {chart.cost == "cpu" ? "CPU seconds per simulated second" : "evaluations of dY/dt",
            true};
  if (chart.floor) plot.guides.push_back({true, *chart.floor, "rounding"});
  for (std::size_t i = 0; i < series.size(); ++i) {
    ChartCurve& curve = plot.curves.emplace_back();
    curve.label = series[i].label;
    curve.colour = seriesColour(i);
    if (const std::optional<double> order = observedOrder(chart, series[i]))
      curve.note = fmt::format("order {:.1f}", *order);
    for (const ChartPoint& point : series[i].points)
      curve.points.emplace_back(point.error, costOf(chart, point));
  }
  return plot;
}

}  // namespace tumble
