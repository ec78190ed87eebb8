#include "app/panel/chart_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "app/claim/claim.h"
#include "app/present/palette.h"
#include "app/record/output.h"

namespace tumble {

namespace {

constexpr double kSmall = 0.1;    // errors below this follow the first term
constexpr double kClear = 100.0;  // times the floor: what rounding adds is less than a percent

double costOf(const ChartDef& chart, const ChartPoint& point) {
  if (chart.cost == "value") {
    double value = 0.0;
    std::from_chars(point.value.data(), point.value.data() + point.value.size(), value);
    return value;
  }
  return chart.cost == "cpu" ? point.cpuShare : static_cast<double>(point.evaluations);
}

ChartPoint runPoint(const Scene& scene, const ChartDef& chart, const Variant& variant) {
  const Scene changed = sceneOf(scene, variant);
  const Recording recording = record(changed, changed.image.rate);
  ChartPoint point;
  point.error = recording.report.stopped ? std::numeric_limits<double>::infinity()
                                         : largestError(chart, changed, recording);
  point.evaluations = recording.report.certificate.evaluations;
  point.cpuShare = recording.cpuSeconds / changed.world.duration;
  return point;
}

// The whole text as a number.
std::optional<double> numberOf(const std::string& text) {
  double value = 0.0;
  const std::from_chars_result end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size()) return {};
  return value;
}

// "samples" for "body.torus.samples", "step / s" for "course.step".
std::string costTitle(const ChartDef& chart) {
  if (chart.cost == "cpu") return "CPU seconds per simulated second";
  if (chart.cost == "evaluations") return "evaluations of dY/dt";
  const std::string key = chart.along.parameter.substr(chart.along.parameter.rfind('.') + 1);
  return key == "step" ? "step / s" : key;
}

}  // namespace

double largestError(const ChartDef& chart, const Scene& scene, const Recording& recording) {
  double largest = 0.0;
  bool any = false;
  for (const ClaimRow& row : findCheck(chart.error)->rows(asRun(scene, recording), recording)) {
    if (row.label.find(chart.row) == std::string::npos) continue;
    largest = std::isnan(row.error) ? row.error : std::max(largest, row.error);
    any = true;
  }
  return any ? largest : std::numeric_limits<double>::infinity();
}

Variant pointVariant(const ChartDef& chart, std::size_t curve, std::size_t point) {
  const CurveDef& def = chart.curves[curve];
  Variant variant = joined(chart.variant, def.variant);
  variant.set.push_back(def.along.setting(point));
  return variant;
}

std::vector<ChartSeries> runChart(const Scene& scene, const ChartDef& chart, const RunDone& done) {
  std::vector<ChartSeries> all;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const Sweep& along = chart.curves[i].along;
    ChartSeries& series = all.emplace_back();
    series.label = chart.curves[i].variant.title;
    series.parameter = along.parameter;
    for (std::size_t k = 0; k < along.values.size(); ++k) {
      series.points.push_back(runPoint(scene, chart, pointVariant(chart, i, k)));
      series.points.back().value = along.values[k];
      done();
    }
  }
  return all;
}

std::optional<double> observedOrder(const ChartDef& chart, const ChartSeries& series) {
  const double floor = chart.floor.value_or(0.0);
  const auto least =
      std::min_element(series.points.begin(), series.points.end(),
                       [](const ChartPoint& a, const ChartPoint& b) { return a.error < b.error; });
  if (series.parameter != chart.along.parameter) return {};
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const ChartPoint& point : series.points) {
    const double abscissa = numberOf(point.value).value_or(costOf(chart, point));
    if (!(point.error < kSmall) || point.error <= kClear * floor || !(abscissa > 0.0) ||
        costOf(chart, point) > costOf(chart, *least))
      continue;
    const double x = std::log10(abscissa), y = std::log10(point.error);
    n += 1.0;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const double spread = n * sxx - sx * sx;
  if (n < 3.0 || !(spread > 0.0)) return {};
  return std::abs(n * sxy - sx * sy) / spread;
}

std::string chartCsv(const std::vector<ChartSeries>& series) {
  std::string csv = "curve,parameter,value,error,evaluations\n";
  for (const ChartSeries& one : series)
    for (const ChartPoint& point : one.points)
      csv += fmt::format("{},{},{},{:.17g},{}\n", csvQuoted(one.label), one.parameter,
                         csvQuoted(point.value), point.error, point.evaluations);
  return csv;
}

Chart chartOf(const ChartDef& chart, const std::vector<ChartSeries>& series) {
  Chart plot;
  plot.title = chart.variant.title;
  plot.subtitle = chart.subtitle;
  plot.x = {"error", true};
  plot.y = {costTitle(chart), true};
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
