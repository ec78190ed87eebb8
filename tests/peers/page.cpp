#include "tests/peers/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "app/file/file.h"
#include "app/file/html.h"
#include "app/report/page.h"
#include "tests/peers/table.h"

namespace tumble::peers {

namespace {

ChartSeries seriesOf(const std::string& label, std::span<const Point> points) {
  ChartSeries series{label, "steps per second", {}};
  for (const Point& point : front(points))
    series.points.push_back(
        {fmt::format("{} {:g}", point.setting, point.rate), point.error, 0, median(point.costs)});
  return series;
}

// One curve of those points that are asked for, if there are any.
template <class Of>
void addCurve(const std::string& label, const std::string& note, std::span<const Point> points,
              Of of, Study& study) {
  std::vector<Point> own;
  std::copy_if(points.begin(), points.end(), std::back_inserter(own), of);
  if (own.empty()) return;
  study.series.push_back(seriesOf(label, own));
  study.orders.emplace_back();
  study.notes.push_back(note);
}

std::vector<std::string> enginesOf(std::span<const Point> points) {
  std::vector<std::string> names;
  for (const Point& point : points)
    if (std::find(names.begin(), names.end(), point.engine) == names.end())
      names.push_back(point.engine);
  return names;
}

std::string tableHtml(std::span<const Outcome> outcomes) {
  std::string out = "<table>\n";
  const auto rows = tableCells(outcomes);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out += "<tr>";
    for (const std::string& cell : rows[i])
      out += fmt::format("<{0}>{1}</{0}>", i == 0 ? "th" : "td", htmlText(cell));
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

std::string setupsHtml(std::span<const EngineSetup> setups) {
  std::string out =
      "<h2>Settings</h2>\n<table><tr><th>engine</th><th>setting</th><th>what for</th></tr>\n";
  for (const EngineSetup& setup : setups)
    out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", htmlText(setup.engine),
                       htmlText(setup.name), htmlText(setup.why));
  return out + "</table>\n";
}

constexpr const char* kIntroduction =
    R"(<p>The same scenes by other engines, each as it comes and as well as we know to set it up, at several
steps: one thread, sleeping off. The error is measured from the poses that an engine leaves, against
the closed form of the scene; of a step the larger of its own and the next finer one's counts, and
what is below 1e-12 is rounding. The cost is CPU time of the bare steps, median of repeats, all runs by
turns. tumble as it comes is asked 60 times a second; "once" is asked for the end alone.</p>
<p>The table has a row for each decade of error that a peer reaches: the cheapest peer there, and
how many times as much it costs as tumble, with the 95 % interval by bootstrap over repeats. Below 1
is lost. Where several errors of a decade were reached, the one that goes worst for tumble stands;
<a href="peers-duels.csv">all of them</a>, <a href="peers.csv">all runs</a>,
<a href="peers-left-out.csv">what did not end or was lost</a>.</p>
)";

}  // namespace

std::vector<Point> recordedPoints(const std::string& path) {
  std::istringstream rows(readFile(path));
  std::vector<Point> points;
  std::string row;
  std::getline(rows, row);
  while (std::getline(rows, row)) {
    std::istringstream cells(row);
    std::vector<std::string> cell(6);
    for (std::string& text : cell)
      if (!std::getline(cells, text, ',')) throw std::runtime_error(path + ": '" + row + "'");
    points.push_back({cell[0],
                      cell[1],
                      cell[2],
                      cell[2].rfind("default", 0) == 0,
                      true,
                      std::stod(cell[3]),
                      std::stod(cell[4]),
                      {std::stod(cell[5])}});
  }
  return points;
}

std::vector<Study> figures(std::span<const Trial> trials, std::span<const Point> points) {
  std::vector<Study> studies;
  for (const Trial& trial : trials) {
    std::vector<Point> own;
    std::copy_if(points.begin(), points.end(), std::back_inserter(own),
                 [&](const Point& point) { return point.scene == trial.name; });
    own = settled(own);
    Study study{"peers-" + trial.name, trial.title, "", {}, {}, {}, {}};
    study.chart.variant.title = trial.title;
    study.chart.subtitle = "Error: " + trial.error + ".";
    study.chart.floor = 0.99 * kRounding;  // so that the figure has room to its left
    addCurve(
        "tumble, as it comes", "60/s", own,
        [](const Point& p) { return p.engine == "tumble" && p.asItComes; }, study);
    for (const std::string& engine : enginesOf(own)) {
      const bool recorded = std::any_of(
          own.begin(), own.end(), [&](const Point& p) { return p.engine == engine && p.recorded; });
      addCurve(
          engine == "tumble" ? "tumble, best" : engine,
          recorded ? "recorded, other machine" : "all settings", own,
          [&](const Point& p) { return p.engine == engine; }, study);
    }
    if (!study.series.empty()) studies.push_back(std::move(study));
  }
  return studies;
}

std::string peersPage(std::span<const Outcome> outcomes, std::span<const Study> studies,
                      std::span<const EngineSetup> setups, const std::string& machine,
                      const std::string& folder) {
  std::string out = pageHead("Beside other engines") + kIntroduction;
  out += fmt::format("<p>Measured on {}.</p>\n", htmlText(machine)) + tableHtml(outcomes);
  for (const Outcome& outcome : outcomes)
    for (const Study& study : studies)
      if (study.name == "peers-" + outcome.scene) out += figureSection(figureOf(study), folder);
  return out + setupsHtml(setups) + "</body></html>\n";
}

}  // namespace tumble::peers
