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

double largestError(const std::string& check, const Scene& scene, const Recording& recording) {
  double largest = 0.0;
  for (const ClaimRow& row : findCheck(check)->rows(scene, recording))
    largest = std::isnan(row.error) ? row.error : std::max(largest, row.error);
  return largest;
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

}  // namespace

std::vector<ChartSeries> runChart(const Scene& scene, const ChartDef& chart, const RunDone& done) {
  std::vector<ChartSeries> all;
  for (const CurveDef& curve : chart.curves) {
    ChartSeries& series = all.emplace_back();
    series.label = curve.variant.title;
    Sweep along = chart.along;
    if (!curve.values.empty()) along.values = curve.values;
    for (std::size_t k = 0; k < along.values.size(); ++k) {
      Variant variant = joined(chart.variant, curve.variant);
      variant.set.push_back(along.setting(k));
      series.points.push_back(runPoint(scene, chart, variant));
      series.points.back().value = along.values[k];
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
