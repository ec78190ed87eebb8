// A graph of a scene: one body, or what formulas come to, against time, in variants, and its plot.
#pragma once

#include "app/panel/variant_run.h"
#include "render/chart.h"

namespace tumble {

/// What one variant shows.
struct GraphSeries {
  std::string label;
  std::vector<Eigen::Vector2d> points = {};  ///< (t [s], what is shown)
  std::vector<Event> impacts = {};           ///< of the body
  std::vector<Eigen::Vector2d> curve = {};   ///< with what is just before and after impacts; or as
                                             ///< the points
};

/// What a graph shows of a body at a sample: height of its centre [m], velocity [m/s] upward, size
/// of the contact force [N], what joints push it upward with [N], or the energy of the whole scene
/// [J].
double shownOf(const std::string& shows, const Sample& sample, int body);

/// Runs every curve; where planes are shown, each is two: with memory and without; of holds, one
/// for each way to hold.
/// @throws SceneError
std::vector<GraphSeries> runGraph(const Scene& scene, const GraphDef& graph, const RunDone& done);

/// Header and rows: curve, t, value; of each curve as many rows as divide it evenly.
std::string graphCsv(const std::vector<GraphSeries>& series, int rows);

/// The plot: time to the right. Where forces are shown, an impact is a dashed line, and the first
/// impulse stands behind the curve's name: no force is large enough for an instant.
Chart graphOf(const GraphDef& graph, const std::vector<GraphSeries>& series);

}  // namespace tumble
