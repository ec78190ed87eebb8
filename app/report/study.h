// One chart of a report: its errors, its costs, and the floor that rounding sets.
#pragma once

#include <span>

#include "app/panel/chart_run.h"

namespace tumble {

/// A chart with everything that is measured of it. Errors and costs come from separate runs.
struct Study {
  std::string name;     ///< of its files
  std::string scene;    ///< title
  std::string chapter;  ///< of the scene
  ChartDef chart;       ///< with `floor` set, cost "cpu"
  std::vector<ChartSeries> series;
  std::vector<std::string> methods;           ///< of each curve: a row of the table of methods
  std::vector<std::optional<double>> orders;  ///< of each curve: error over the chart's number
  std::vector<std::string> notes = {};        ///< of each curve, in place of an order
};

/// Name for the files of a scene's next study: the scene's own, or, where an earlier study or the
/// headline table has that, with the first number from 2 on that is free.
std::string freeName(const std::string& scene, std::span<const Study> earlier);

/// Runs a chart of a scene; the study has no name yet.
/// @param budget  [s] of CPU time for the cost of each point
/// @throws SceneError, also if no run has an error that can be drawn.
Study runStudy(const Scene& scene, std::size_t chart, double budget, const RunDone& done);

/// The error that double precision leaves whatever the method: starts that differ by a unit in the
/// last place in every number of the state, held to the check of the unchanged scene. The median of
/// what that changes of the largest error.
/// @param scene    whose check holds
/// @param flown    the same scene with the settings that fly the ensemble
/// @param members  of the ensemble
double roundingFloor(const Scene& scene, const Scene& flown, const ChartDef& chart, int members);

/// curve, parameter, value, error, evaluations, cpu_seconds_per_second: a row for each run.
std::string studyCsv(const Study& study);

}  // namespace tumble
