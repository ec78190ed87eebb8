#include "app/panel/page.h"

#include <algorithm>

namespace tumble {

namespace {

// Width [px] of the page that a panel is drawn for: text is nearly as large as the captions.
constexpr double kPanelWidth = 800.0;

}  // namespace

std::size_t runsOf(const Scene& scene) {
  std::size_t runs = scene.panels.size();
  for (const ChartDef& chart : scene.charts)
    for (const CurveDef& curve : chart.curves) runs += curve.along.values.size();
  return runs;
}

std::string chartName(std::size_t i) {
  return i == 0 ? "chart" : "chart-" + std::to_string(i + 1);
}

PageRuns runPage(const Scene& scene, const RunDone& done) {
  PageRuns runs;
  runs.panels = runPanels(scene, done);
  for (const ChartDef& chart : scene.charts) runs.charts.push_back(runChart(scene, chart, done));
  return runs;
}

double panelPage(const Scene& scene) {
  return kPanelWidth * scene.image.height / scene.image.width;
}

Image drawPage(const Scene& scene, const PageRuns& runs, int width, const DrawPanel& draw,
               Fonts& fonts) {
  const int height = panelHeight(scene, width);
  std::vector<Panel> panels = drawPanels(runs.panels, draw);
  for (std::size_t i = 0; i < runs.charts.size(); ++i) {
    Chart chart = chartOf(scene.charts[i], runs.charts[i]);
    chart.title.clear();
    chart.subtitle.clear();
    panels.push_back({drawChart(chart, width, height, width / kPanelWidth, fonts),
                      scene.charts[i].variant.title, scene.charts[i].subtitle});
  }
  return drawSheet(panels, columnsOf(panels.size()), scene.title, scene.subtitle, fonts);
}

}  // namespace tumble
