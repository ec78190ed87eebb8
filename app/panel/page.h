// The page of a scene with several pictures: its panels, then its graphs and charts.
#pragma once

#include "app/panel/chart_run.h"
#include "app/panel/graph_run.h"

namespace tumble {

/// Everything that a scene's [[panel]], [[graph]] and [[chart]] tables ask for, run.
struct PageRuns {
  std::deque<VariantRun> panels;
  std::vector<std::vector<GraphSeries>> graphs;  ///< as in the scene
  std::vector<std::vector<ChartSeries>> charts;  ///< as in the scene
};

/// How many runs that takes; 0 for a scene without panels, graphs and charts.
std::size_t runsOf(const Scene& scene);

/// @param done  told after each run
/// @throws SceneError
PageRuns runPage(
    const Scene& scene, const RunDone& done = [] {});

/// "chart", "chart-2", …: the file of the i-th chart, without its ending.
std::string chartName(std::size_t i);

/// A graph or chart of a page: its plot, and its numbers that are the same on every machine.
struct Plot {
  std::string name;  ///< of its files, without ending: "graph", "graph-2", …, "chart", …
  Chart chart;
  std::string csv;
};

/// The names of all plots of a scene with their titles, in the order of `plotsOf`.
std::vector<std::pair<std::string, std::string>> plotNames(const Scene& scene);

/// All graphs, then all charts.
std::vector<Plot> plotsOf(const Scene& scene, const PageRuns& runs);

/// One sheet with everything.
/// @param width  [px] of a panel; its height is in the proportion of the scene's images
/// @param draw   draws a picture at that size, its text as large as that of the charts
Image drawPage(const Scene& scene, const PageRuns& runs, int width, const DrawPanel& draw,
               Fonts& fonts);

}  // namespace tumble
