#include "app/panel/page.h"

#include <algorithm>
#include <utility>

namespace tumble {

namespace {

constexpr int kGraphRows =
    20;  // intervals between the numbers that a graph's file keeps of a curve

std::string numbered(const char* name, std::size_t i) {
  return i == 0 ? name : name + ("-" + std::to_string(i + 1));
}

}  // namespace

std::size_t runsOf(const Scene& scene) {
  std::size_t runs = scene.panels.size();
  for (const ChartDef& chart : scene.charts)
    for (const CurveDef& curve : chart.curves) runs += curve.along.values.size();
  for (const GraphDef& graph : scene.graphs) runs += graph.curves.size();
  return runs;
}

std::string chartName(std::size_t i) {
  return numbered("chart", i);
}

std::vector<std::pair<std::string, std::string>> plotNames(const Scene& scene) {
  std::vector<std::pair<std::string, std::string>> names;
  for (std::size_t i = 0; i < scene.graphs.size(); ++i)
    names.emplace_back(numbered("graph", i), scene.graphs[i].variant.title);
  for (std::size_t i = 0; i < scene.charts.size(); ++i)
    names.emplace_back(chartName(i), scene.charts[i].variant.title);
  return names;
}

std::vector<Plot> plotsOf(const Scene& scene, const PageRuns& runs) {
  const std::vector<std::pair<std::string, std::string>> names = plotNames(scene);
  std::vector<Plot> plots;
  for (std::size_t i = 0; i < scene.graphs.size(); ++i)
    plots.push_back({names[i].first, graphOf(scene.graphs[i], runs.graphs[i]),
                     graphCsv(runs.graphs[i], kGraphRows)});
  for (std::size_t i = 0; i < scene.charts.size(); ++i)
    plots.push_back(
        {chartName(i), chartOf(scene.charts[i], runs.charts[i]), chartCsv(runs.charts[i])});
  return plots;
}

PageRuns runPage(const Scene& scene, const RunDone& done) {
  PageRuns runs;
  runs.panels = runPanels(scene, done);
  for (const GraphDef& graph : scene.graphs) runs.graphs.push_back(runGraph(scene, graph, done));
  for (const ChartDef& chart : scene.charts) runs.charts.push_back(runChart(scene, chart, done));
  return runs;
}

Image drawPage(const Scene& scene, const PageRuns& runs, int width, const DrawPanel& draw,
               Fonts& fonts) {
  const int height = panelHeight(scene, width);
  std::vector<Panel> panels = drawPanels(runs.panels, panelPage(scene), draw);
  std::vector<Plot> plots = plotsOf(scene, runs);
  const int columns = columnsOf(panels.size() + plots.size());
  for (Plot& plot : plots) {
    const std::string title = std::exchange(plot.chart.title, "");
    const std::string subtitle = std::exchange(plot.chart.subtitle, "");
    // The last plot takes what is free in its row.
    const bool last = &plot == &plots.back();
    const int free = columns - static_cast<int>(panels.size()) % columns;
    panels.push_back({drawChart(plot.chart, spanningWidth(width, last ? free : 1), height,
                                width / panelPage(scene).x(), fonts),
                      title, subtitle});
  }
  return drawSheet(panels, columns, scene.title, scene.subtitle, fonts);
}

}  // namespace tumble
