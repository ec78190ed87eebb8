// A figure of the report: a gnuplot script beside its numbers, and what gnuplot makes of it.
#pragma once

#include "app/report/study.h"

namespace tumble {

/// A script that draws <name>.csv into <name>.svg and <name>.png when gnuplot runs it in their
/// folder: error to the right, CPU seconds per simulated second upwards, both logarithmic, the
/// floor dashed. The first curve is drawn thick; colours (Okabe and Ito) and markers belong to the
/// curve's place in the chart.
/// @param caption  one line below the axes: machine and build
std::string plotScript(const Study& study, const std::string& caption);

/// Runs gnuplot on <name>.gp in the folder.
/// @throws FileError if it is not there or fails.
void runGnuplot(const std::string& folder, const std::string& name);

}  // namespace tumble
