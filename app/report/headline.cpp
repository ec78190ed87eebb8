#include "app/report/headline.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/record/output.h"

namespace tumble {

std::vector<HeadlineRow> headlineRows(const std::vector<Study>& studies) {
  std::vector<HeadlineRow> rows;
  for (const Study& study : studies) {
    for (const ChartSeries& series : study.series) {
      HeadlineRow row{study.chart.variant.title, series.label, {}, 0.0};
      row.best = std::numeric_limits<double>::infinity();
      for (const ChartPoint& point : series.points) {
        row.best = std::min(row.best, point.error);
        for (std::size_t k = 0; k < kGoals.size(); ++k)
          if (point.error <= kGoals[k])
            row.cost[k] = std::min(row.cost[k].value_or(point.cpuShare), point.cpuShare);
      }
      rows.push_back(row);
    }
  }
  return rows;
}

std::string headlineCsv(const std::vector<HeadlineRow>& rows) {
  std::string csv = "scene,curve";
  for (const double goal : kGoals) csv += fmt::format(",cpu_seconds_per_second_to_{:.0e}", goal);
  csv += ",best_error\n";
  for (const HeadlineRow& row : rows) {
    csv += csvQuoted(row.scene) + "," + csvQuoted(row.curve);
    for (const std::optional<double>& cost : row.cost)
      csv += cost ? fmt::format(",{:.4g}", *cost) : ",";
    csv += fmt::format(",{:.4g}\n", row.best);
  }
  return csv;
}

std::string headlineMarkdown(const std::vector<HeadlineRow>& rows) {
  std::string text = "| scene | method |";
  for (const double goal : kGoals) text += fmt::format(" CPU s per s to {:.0e} |", goal);
  text += " best error |\n|---|---|";
  for (std::size_t k = 0; k < kGoals.size(); ++k) text += "---|";
  text += "---|\n";
  for (const HeadlineRow& row : rows) {
    text += fmt::format("| {} | {} |", row.scene, row.curve);
    for (const std::optional<double>& cost : row.cost)
      text += cost ? fmt::format(" {:.1e} |", *cost) : " – |";
    text += fmt::format(" {:.1e} |\n", row.best);
  }
  return text;
}

}  // namespace tumble
