// What costs how much more when there is more of it: finding contacts, and crowds.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tumble {

/// One way to do it.
struct ScalingCurve {
  std::string label;
  std::vector<std::pair<int, double>> points;  ///< (how much, CPU seconds)
  double slope = 0.0;                          ///< on logarithmic axes, least squares
};

/// A figure: CPU time against size, both logarithmic.
struct Scaling {
  std::string name;  ///< of its files
  std::string title, subtitle, across, upwards;
  std::vector<ScalingCurve> curves;
};

/// A step of every broad phase with 100 boxes to so many; the slow ones stop earlier.
Scaling broadPhaseScaling(int most = 100000);

/// Two convex hulls near each other, by their corners: a full search for a plane that parts them,
/// and the question whether a remembered one does.
Scaling searchScaling();

/// Boxes that fall into a tray with room for each, 25 to so many, by some presets of `stepping`.
Scaling crowdScaling(int most = 400);

/// curve, size, cpu_seconds: a row for each point.
std::string scalingCsv(const Scaling& scaling);

}  // namespace tumble
