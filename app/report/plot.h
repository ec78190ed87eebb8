// A figure of the report: a gnuplot script beside its numbers, and what gnuplot makes of it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/file/file.h"
#include "app/report/profile.h"
#include "app/report/scaling.h"
#include "app/report/study.h"

namespace tumble {

/// A script that draws <name>.csv into <name>.svg and <name>.png when gnuplot runs it in their
/// folder: error to the right, CPU seconds per simulated second upwards, both logarithmic, the
/// floor dashed. The first curve is drawn thick; colours (Okabe and Ito) and markers belong to the
/// place of the curve's label among `labels`.
/// @param labels   of the curves of all figures that are to be told apart
/// @param caption  one line below the axes: machine and build
std::string plotScript(const Study& study, std::span<const std::string> labels,
                       const std::string& caption);

/// The same for <name>.csv of a scaling: size to the right, CPU seconds upwards, slopes in the
/// legend.
std::string plotScript(const Scaling& scaling, const std::string& caption);

/// The same for <name>.csv of a profile: times the fastest to the right, share solved upwards, the
/// share in the end in the legend.
std::string plotScript(const Profile& profile, const std::string& caption);

/// Labels of all curves of the studies, each once, in the order in which they come.
std::vector<std::string> labelsOf(std::span<const Study> studies);

/// That gnuplot cannot be run.
class NoGnuplot : public FileError {
 public:
  using FileError::FileError;
};

/// Runs gnuplot on <name>.gp in the folder.
/// @throws NoGnuplot if it is not there; FileError if it fails, or leaves a figure that is not
///         whole. Then there is neither.
void runGnuplot(const std::string& folder, const std::string& name);

}  // namespace tumble
