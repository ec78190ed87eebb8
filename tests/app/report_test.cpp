// Speed against error: what is measured, how it is put in files, and what the table says.
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

#include "app/claim/claim.h"
#include "app/file/data.h"
#include "app/file/file.h"
#include "app/panel/variant_run.h"
#include "app/report/headline.h"
#include "app/report/page.h"
#include "app/report/plot.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

constexpr const char* kOrbit = R"(
[world]
gravity = [0, 0, 0]
duration = 1.0
method = "course"
[[body]]
name = "dot"
shape = "particle"
mass = 1.0
position = [1, 0, 0]
velocity = [0, 1, 0]
[[force]]
kind = "field"
axis = [0, 0, 1]
rate = 1.0
[image]
rate = 10.0
[[chart]]
title = "A dot & its orbit"
error = "orbit"
along = "course.step"
values = [0.1, 0.05, 0.025, 0.0125]
curves = [
  { label = "RK4, \"four\"" },
  { label = "Euler", set = { "course.integrator" = "euler" }, values = [0.1, 0.02, 0.004, 0.0008] },
]
)";

/// The orbit's scene in a file, for as long as a test runs.
struct OrbitFile {
  std::string path = (std::filesystem::temp_directory_path() /
                      ("tumble-report-" + std::to_string(::getpid()) + ".toml"))
                         .string();
  OrbitFile() { writeFile(path, kOrbit); }
  ~OrbitFile() { std::filesystem::remove(path); }
};

/// Curves of a known shape: error n⁻⁴ at a cost of n µs.
Study knownStudy() {
  Study study;
  study.name = "known";
  study.chart.variant.title = "Known";
  study.chart.along.parameter = "course.step";
  study.chart.floor = 1e-15;
  study.series.resize(2);
  study.series[0].label = "fourth";
  study.series[1].label = "first";
  for (ChartSeries& series : study.series) series.parameter = "course.step";
  for (const double n : {1.0, 10.0, 100.0, 1000.0}) {
    study.series[0].points.push_back({"x", std::pow(n, -4.0), 0, 1e-6 * n});
    study.series[1].points.push_back({"x", 1.0 / n, 0, 1e-6 * n});
  }
  study.orders = {4.0, {}};
  return study;
}

}  // namespace

// Oracle: closed forms of the two integrators' errors in the field: RK4 t h⁴/120 in phase, Euler
// t h/2 in radius; orders within 0.1.
TEST_CASE("a study measures errors, orders, costs and the floor of a chart") {
  const OrbitFile file;
  const Scene scene = readScene(file.path);
  int done = 0;
  const Study study = runStudy(scene, 0, 1e-3, [&] { ++done; });
  CHECK(done == 8);
  REQUIRE(study.series.size() == 2);
  CHECK(study.series[0].points[0].error == Approx(1e-4 / 120.0).epsilon(0.1));
  CHECK(study.series[1].points[2].error == Approx(0.004 / 2.0).epsilon(0.1));
  REQUIRE(study.orders[0]);
  REQUIRE(study.orders[1]);
  CHECK(*study.orders[0] == Approx(4.0).margin(0.1));
  CHECK(*study.orders[1] == Approx(1.0).margin(0.1));
  for (const ChartSeries& series : study.series)
    for (const ChartPoint& point : series.points) CHECK(point.cpuShare > 0.0);
  // A few units in the last place. Measured 2e-16.
  REQUIRE(study.chart.floor);
  CHECK((*study.chart.floor > 1e-17 && *study.chart.floor < 1e-14));

  // A row for each point below the header; quotes are doubled.
  std::istringstream csv(studyCsv(study));
  std::string line;
  std::getline(csv, line);
  CHECK(line == "curve,parameter,value,error,evaluations,cpu_seconds_per_second");
  std::getline(csv, line);
  CHECK(line.rfind("\"RK4, \"\"four\"\"\",course.step,\"0.1\",", 0) == 0);
  int rows = 1;
  while (std::getline(csv, line)) ++rows;
  CHECK(rows == 8);
}

// Oracle: the definition. At a cost of n µs the error is n⁻⁴ and n⁻¹.
TEST_CASE("the headline table names the cheapest run that is right to each goal") {
  const std::vector<HeadlineRow> rows = headlineRows({knownStudy()});
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].cost[0].value_or(0.0) == Approx(1e-5));
  CHECK(rows[0].cost[1].value_or(0.0) == Approx(1e-4));
  CHECK(rows[0].cost[2].value_or(0.0) == Approx(1e-3));
  CHECK(rows[0].best == Approx(1e-12));
  CHECK(rows[1].cost[0].value_or(0.0) == Approx(1e-3));
  CHECK(!rows[1].cost[1]);
  CHECK(headlineCsv(rows).find("\"Known\",\"first\",0.001,,,0.001\n") != std::string::npos);
  CHECK(headlineMarkdown(rows).find("| Known | first | 1.0e-03 | – | – | 1.0e-03 |\n") !=
        std::string::npos);
}

TEST_CASE("the script draws every curve from the numbers beside it, the floor dashed") {
  const std::string script =
      plotScript(knownStudy(), labelsOf(std::vector{knownStudy()}), "this machine");
  CHECK(script.find("plot './known.csv' skip 1 every ::0::3 using 4:6 ") != std::string::npos);
  CHECK(script.find(" './known.csv' skip 1 every ::4::7 using 4:6 ") != std::string::npos);
  CHECK(script.find("title 'fourth  (order 4.0)'") != std::string::npos);
  CHECK(script.find("title 'first'") != std::string::npos);
  CHECK(script.find("set output './known.svg'") != std::string::npos);
  CHECK(script.find("set output './known.png'") != std::string::npos);
  CHECK(script.find("set xrange [1e-15:1e1]\n") != std::string::npos);
  CHECK(script.find("from 1e-15, graph 0") != std::string::npos);
  CHECK(script.find("this machine") != std::string::npos);
  Study bare = knownStudy();
  bare.chart.floor.reset();
  CHECK(plotScript(bare, labelsOf(std::vector{bare}), "").find("dashtype") == std::string::npos);
  // No decade is drawn that no error reaches.
  Study close = knownStudy();
  for (ChartSeries& series : close.series)
    for (ChartPoint& point : series.points) point.error *= 2e-6;
  close.series[1].points.push_back({"x", std::numeric_limits<double>::infinity(), 0, 1e-6});
  CHECK(plotScript(close, labelsOf(std::vector{close}), "").find("set xrange [1e-18:1e-5]\n") !=
        std::string::npos);
  // The least error is in the picture however large it is.
  Study wild = knownStudy();
  for (ChartSeries& series : wild.series)
    for (ChartPoint& point : series.points) point.error *= 2e15;
  CHECK(plotScript(wild, labelsOf(std::vector{wild}), "").find("set xrange [1e-15:1e4]\n") !=
        std::string::npos);
}

// Within gnuplot's single quotes nothing but the quote has a meaning.
TEST_CASE("what the script quotes of a scene stays text") {
  const std::string text = "`date` \"a\" 'b' \\ $(date) @c {d";
  const std::string quoted = "'`date` \"a\" ''b'' \\ $(date) @c {d'";
  Study study = knownStudy();
  study.name = text;
  study.chart.variant.title = study.chart.subtitle = study.series[1].label = text;
  const std::string script = plotScript(study, labelsOf(std::vector{study}), text);
  CHECK(script.find("set title " + quoted + " noenhanced\n") != std::string::npos);
  CHECK(script.find("set label 1 " + quoted + " at ") != std::string::npos);
  CHECK(script.find("set label 2 " + quoted + " at ") != std::string::npos);
  CHECK(script.find(" title " + quoted + "\n") != std::string::npos);
  CHECK(script.find("'./" + quoted.substr(1, quoted.size() - 2) + ".csv' skip") !=
        std::string::npos);
}

TEST_CASE("every study writes files of its own, none over the headline table") {
  std::vector<Study> studies;
  for (const char* scene : {"st", "st", "st-2", "other", "st", "table"}) {
    Study study;
    study.name = freeName(scene, studies);
    studies.push_back(study);
  }
  std::vector<std::string> names;
  for (const Study& study : studies) names.push_back(study.name);
  CHECK(names == std::vector<std::string>{"st", "st-2", "st-2-2", "other", "st-3", "table-2"});
}

TEST_CASE(
    "the page holds its figures, leaves them out if they are not drawn, and escapes what it "
    "quotes") {
  Study study = knownStudy();
  study.chart.variant.title = "A < B";
  study.chapter = "methods";
  const std::vector<Chapter> chapters = chaptersOf({study}, {});
  REQUIRE(chapters.size() == 2);
  CHECK(chapters[0].title == "Methods");
  const std::string bare = reportPage("Title", "this machine", chapters, "");
  CHECK(bare.find("<img") == std::string::npos);
  CHECK(bare.find("A &lt; B") != std::string::npos);

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("tumble-page-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  writeFile((folder / "known.svg").string(), "<svg/>");
  const std::string page = reportPage("Title", "this machine", chapters, folder.string());
  CHECK(page.find("src=\"data:image/svg+xml;base64,PHN2Zy8+\"") != std::string::npos);
  std::filesystem::remove_all(folder);
  CHECK_THROWS_AS(reportPage("Title", "this machine", chapters, folder.string()), FileError);
}

TEST_CASE("charts of scenes that name one chapter stand together") {
  std::vector<Study> studies(4, knownStudy());
  studies[0].chapter = studies[2].chapter = "methods";
  studies[1].chapter = "crowds";
  const std::vector<Chapter> chapters = chaptersOf(studies, {});
  REQUIRE(chapters.size() == 4);
  CHECK(chapters[0].title == "Methods");
  CHECK(chapters[0].figures.size() == 2);
  CHECK(chapters[1].title == "Crowds");
  CHECK(chapters[2].title == "Charts");
  CHECK(chapters[3].title == "Time to an accuracy");
}

// Oracle: the table of methods. `exact` takes no springs; what flies alone is taken by all.
TEST_CASE("prices are asked of every method, and left out where it refuses the scene") {
  const Scene ladder = readScene(dataFolder("report") + "/parts/rungs.toml");
  std::vector<Scene> rungs;
  for (const PanelDef& panel : ladder.panels) {
    if (panel.variant.title != "a particle flies" && panel.variant.title != "a ball on a spring")
      continue;
    rungs.push_back(sceneOf(ladder, panel.variant));
    rungs.back().title = panel.variant.title;
    rungs.back().world.duration = 0.1;
  }
  const std::vector<Price> prices = pricesOf(rungs, 0.0);
  REQUIRE(prices.size() == 2);
  const std::vector<MethodName> methods = methodNames();
  for (std::size_t k = 0; k < methods.size(); ++k) {
    CAPTURE(methods[k].name);
    CHECK(prices[0].seconds[k].value_or(0.0) > 0.0);
    CHECK(prices[1].seconds[k].has_value() == (methods[k].name != "exact"));
  }
  CHECK(prices[0].uses == std::vector<std::string>{"gravity"});
  CHECK(prices[1].uses == std::vector<std::string>{"gravity", "springs"});
}

TEST_CASE(
    "the report's own scenes can be run, with at least eight points for a curve that has steps") {
  int curves = 0;
  for (const auto& entry : std::filesystem::directory_iterator(dataFolder("report"))) {
    if (entry.path().extension() != ".toml") continue;
    const Scene scene = readScene(entry.path().string());
    CAPTURE(scene.name);
    REQUIRE(!scene.charts.empty());
    for (const ChartDef& chart : scene.charts) {
      CHECK(findCheck(chart.error) != nullptr);
      for (std::size_t i = 0; i < chart.curves.size(); ++i, ++curves) {
        const Scene first = sceneOf(scene, pointVariant(chart, i, 0));
        CAPTURE(chart.curves[i].variant.title);
        CHECK_NOTHROW(makeWorld(first));
        const std::size_t points = chart.curves[i].along.values.size();
        CHECK(points >= (first.world.method == "exact" ? 1u : 8u));
      }
    }
  }
  CHECK(curves > 0);
}
