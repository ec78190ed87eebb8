// The comparison as figures and a page, in the manner of `tumble report`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/report/study.h"
#include "tests/peers/cheapest.h"

namespace tumble::peers {

/// Points measured on another machine, from a CSV file: scene, engine, setting, steps_per_second,
/// error, cpu_seconds_per_second, source.
/// @throws FileError for a file, std::runtime_error for a row, that cannot be read
std::vector<Point> recordedPoints(const std::string& path);

/// A figure for each trial that has points: ours as it comes and at its best, then the front of
/// each engine's settings.
std::vector<Study> figures(std::span<const Trial> trials, std::span<const Point> points);

/// peers.html: the table, scenes that are lost first, then the figures in the same order.
/// @param folder  whose figures are put into the page; "" leaves them out
std::string peersPage(std::span<const Outcome> outcomes, std::span<const Study> studies,
                      std::span<const EngineSetup> setups, const std::string& machine,
                      const std::string& folder);

}  // namespace tumble::peers
