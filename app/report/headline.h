// The headline table: how long each method takes to an accuracy, and how far it comes at all.
#pragma once

#include <array>

#include "app/report/study.h"

namespace tumble {

/// The accuracies that the table asks for.
inline constexpr std::array<double, 3> kGoals = {1e-3, 1e-6, 1e-9};

/// A row: one curve of one chart.
struct HeadlineRow {
  std::string scene, curve;
  std::array<std::optional<double>, kGoals.size()> cost;  ///< [CPU s per s] of the cheapest point
  double best = 0.0;                                      ///< least error of the curve
};

std::vector<HeadlineRow> headlineRows(const std::vector<Study>& studies);

/// The table as CSV, an unreachable goal left empty, and as Markdown, with a dash.
std::string headlineCsv(const std::vector<HeadlineRow>& rows);
std::string headlineMarkdown(const std::vector<HeadlineRow>& rows);

}  // namespace tumble
