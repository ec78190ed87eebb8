// Variants run side by side: pages of panels, and charts of errors.
// Long: pages, charts and graphs are drawn from the scenes of one folder.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/claim/verdict.h"
#include "app/command/command.h"
#include "app/command/shoot.h"
#include "app/file/data.h"
#include "app/file/file.h"
#include "app/panel/page.h"
#include "tests/catch.h"
#include "tests/folder.h"

using namespace tumble;
using tumble::test::Folder;
namespace fs = std::filesystem;

namespace {

// A ball that bounces; Euler's parabola is wrong by g h t / 2, that of RK4 by rounding alone.
constexpr const char* kBounce = R"(
title = "Two steps"
checks = ["first-hit"]
[world]
method = "course"
duration = 0.7
[materials.rubber]
density = 1000.0
restitution = 0.5
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[body]]
name = "ball"
shape = { sphere = 0.1 }
material = "rubber"
position = [0, 1.1, 0]
[[body]]
name = "other"
shape = { sphere = 0.1 }
material = "rubber"
position = [3, 2.1, 0]
[image]
size = [64, 36]
rate = 20.0
[[panel]]
title = "both"
[[panel]]
title = "slow"
subtitle = "on the moon"
set = { "world.gravity" = [0, -1.62, 0] }
[[panel]]
title = "one"
bodies = ["floor", "ball"]
picture = "still"
at = 0.25
[[chart]]
title = "First hit"
error = "first-hit"
bodies = ["floor", "ball"]
along = "course.step"
values = [0.02, 0.01, 0.005, 0.0025]
floor = 1e-15
curves = [
  { label = "Euler", set = { "course.integrator" = "euler" } },
  { label = "RK4", values = [0.02] },
]
)";

Scene bounceIn(const Folder& folder) {
  writeFile(folder / "bounce.toml", kBounce);
  return readScene(folder / "bounce.toml");
}

}  // namespace

TEST_CASE("each panel runs its own variant, and what can be compared shares a camera") {
  const Folder folder;
  const Scene scene = bounceIn(folder);
  CHECK(runsOf(scene) == 3 + 4 + 1);
  int done = 0;
  const std::deque<VariantRun> runs = runPanels(scene, [&] { ++done; });
  CHECK(done == 3);
  REQUIRE(runs.size() == 3);
  CHECK(runs[0].scene.world.gravity.y() == -9.81);
  CHECK(runs[1].scene.world.gravity.y() == -1.62);
  CHECK(runs[1].subtitle == "on the moon");
  CHECK(runs[2].scene.world.bodies.size() == 2);

  std::vector<Picture> pictures;
  const std::vector<Panel> panels = drawPanels(runs, {800.0, 450.0}, [&](const Picture& picture) {
    pictures.push_back(picture);
    return Image{1, 1, {0, 0, 0}};
  });
  CHECK(panels[1].caption == "slow");
  CHECK(panels[1].finding == "on the moon");
  CHECK(pictures[0].camera.eye == pictures[1].camera.eye);
  CHECK(pictures[0].camera.eye != pictures[2].camera.eye);
  // A strobe has ghosts; a still shows one instant: y = 1.1 m − g t²/2 after a quarter of a second.
  CHECK(pictures[0].instances.size() > 2);
  REQUIRE(pictures[2].instances.size() == 1);
  // Oracle: closed form. Measured 4e-16 m, allowed 1e-12.
  CHECK(std::abs(pictures[2].instances[0].position.y() - (1.1 - 0.5 * 9.81 * 0.0625)) < 1e-12);
}

// A claim of one's own is about the scene as it stands, which a panel may change.
TEST_CASE("a panel has claims in the words below it, and none on its picture") {
  const Folder folder;
  writeFile(folder / "bounce.toml",
            std::string(kBounce) +
                "[[expect]]\nvalue = \"ball.y\"\nover = \"max\"\nequals = 1.1\n"
                "[[expect]]\nvalue = \"t\"\nequals = 9\n");
  const Scene scene = readScene(folder / "bounce.toml");
  const std::deque<VariantRun> runs = runPanels(scene, [] {});
  std::vector<Picture> pictures;
  const auto draw = [&](const Picture& picture) {
    pictures.push_back(picture);
    return Image{1, 1, {0, 0, 0}};
  };
  const std::vector<Panel> panels = drawPanels(runs, {800.0, 450.0}, draw);
  const Vec3 claimed = pictures.at(0).camera.eye;
  const std::string end = fmt::format("{:g}", scene.world.duration);
  CHECK(panels[0].finding == "ball.y, max: 1.1, expected 1.1; t, at the end: " + end +
                                 ", expected 9; dotted: what is expected");
  CHECK(panels[1].finding.starts_with("on the moon; ball.y, max: 1.1, expected 1.1; "));
  for (const Picture& picture : pictures) {
    CHECK(picture.remarks.empty());
    for (const Label& label : picture.labels)
      CHECK(label.text.find("expected") == std::string::npos);
  }

  // Nor do they take room on it.
  writeFile(folder / "bounce.toml", kBounce);
  pictures.clear();
  drawPanels(runPanels(readScene(folder / "bounce.toml"), [] {}), {800.0, 450.0}, draw);
  REQUIRE(pictures.size() == 3);
  CHECK(pictures[0].camera.eye == claimed);
}

// One ball falls 0.1 m, the other 10 m: the first alone would stand on lines 0.1 m apart.
TEST_CASE("panels that are seen from as far stand on the same grid") {
  const Folder folder;
  writeFile(folder / "falls.toml", R"(
title = "Two falls"
[world]
duration = 1.4
[materials.rubber]
density = 1000.0
restitution = 0.0
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[body]]
name = "low"
shape = { sphere = 0.1 }
material = "rubber"
position = [0, 0.2, 0]
[[body]]
name = "high"
shape = { sphere = 0.1 }
material = "rubber"
position = [3, 10.1, 0]
[[panel]]
title = "low"
bodies = ["floor", "low"]
set = { "camera.eye" = [0, 1, 20], "camera.target" = [0, 1, 0] }
[[panel]]
title = "high"
bodies = ["floor", "high"]
set = { "camera.eye" = [3, 1, 20], "camera.target" = [3, 1, 0] }
[[panel]]
title = "near"
bodies = ["floor", "low"]
set = { "camera.eye" = [0, 1, 2], "camera.target" = [0, 1, 0] }
)");
  const std::deque<VariantRun> runs = runPanels(readScene(folder / "falls.toml"), [] {});
  std::vector<double> grids;
  drawPanels(runs, {800.0, 450.0}, [&](const Picture& picture) {
    grids.push_back(picture.floor.grid);
    return Image{1, 1, {0, 0, 0}};
  });
  REQUIRE(grids.size() == 3);
  CHECK(grids[0] == grids[1]);
  CHECK(grids[2] < grids[0]);
}

TEST_CASE("a chart holds the largest error of its check against the cost of each run") {
  const Folder folder;
  const Scene scene = bounceIn(folder);
  const std::vector<ChartSeries> series = runChart(scene, scene.charts[0], [] {});
  REQUIRE(series.size() == 2);
  REQUIRE(series[0].points.size() == 4);
  REQUIRE(series[1].points.size() == 1);
  // The same run by hand.
  const Scene euler =
      readScene(folder / "bounce.toml",
                {"course.integrator=euler", "course.step=0.01", "body.other.fixed=true"});
  const Recording recording = record(euler, euler.image.rate);
  CHECK(series[0].points[1].value == "0.01");
  double largest = 0.0;
  std::vector<ClaimRow> rows = judge(euler, recording).rows;
  std::erase_if(rows, [](const ClaimRow& row) { return row.label.starts_with("audit"); });
  for (const ClaimRow& row : rows) largest = std::max(largest, row.error);
  CHECK(largest > 0.0);
  CHECK(series[0].points[1].error == Approx(largest).epsilon(1e-9));
  for (std::size_t k = 1; k < 4; ++k) {
    CHECK(series[0].points[k].error < series[0].points[k - 1].error);
    CHECK(series[0].points[k].evaluations > series[0].points[k - 1].evaluations);
  }
  CHECK(series[1].points[0].error < 1e-3 * series[0].points[0].error);

  // One row alone, and one that is not there.
  ChartDef one = scene.charts[0];
  const ClaimRow last = rows.back();
  one.row = last.label;
  CHECK(largestError(one, euler, recording) == last.error);
  one.row = "no such row";
  CHECK(std::isinf(largestError(one, euler, recording)));

  const std::string csv = chartCsv(series);
  CHECK(
      csv.starts_with("curve,parameter,value,error,evaluations\n\"Euler\",course.step,\"0.02\","));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 6);
}

// Oracle: closed form, errors made as 3 n^−4 down to a floor of 1e-12 where they stay.
TEST_CASE("the observed order is the slope where rounding has no part") {
  ChartDef chart;
  chart.floor = 1e-12;
  ChartSeries series;
  // Too coarse for the first term: off the line, and left out.
  for (const long n : {1L, 2L}) series.points.push_back({"", 2.0, n, 0.0});
  for (const long n : {10L, 20L, 40L, 80L, 160L, 320L, 640L, 1280L, 2560L, 5120L})
    series.points.push_back({"", std::max(1e-12, 3.0 / std::pow(double(n), 4.0)), n, 0.0});
  series.points.push_back({"", std::numeric_limits<double>::infinity(), 5, 0.0});
  const std::optional<double> order = observedOrder(chart, series);
  REQUIRE(order);
  CHECK(std::abs(*order - 4.0) < 1e-9);  // measured 6e-15
  const Chart plot = chartOf(chart, {series});
  CHECK(plot.curves[0].note == "order 4.0");
  CHECK(plot.x.logarithmic);
  CHECK(plot.guides.size() == 1);
  series.points.resize(2);
  CHECK_FALSE(observedOrder(chart, series));

  // Over the chart's key where that is a number: e = h³, though the cost grows like h^−1/2 alone.
  ChartSeries third;
  for (const char* h : {"0.1", "0.01", "0.001"}) {
    const double step = std::stod(h);
    third.points.push_back({h, std::pow(step, 3.0), std::lround(1e3 / std::sqrt(step)), 0.0});
  }
  CHECK(std::abs(observedOrder(chart, third).value_or(0.0) - 3.0) < 1e-9);  // measured 6e-15
}

TEST_CASE("the page and every chart become files, drawn once") {
  const Folder folder;
  const Scene scene = bounceIn(folder);
  Studio studio;
  Shoot shoot(scene, folder / "out", studio);
  const std::vector<std::string> files = shoot.panels();
  REQUIRE(files == std::vector<std::string>{folder / "out/panels.png", folder / "out/chart.png"});
  const Image page = readPng(files[0]);
  CHECK(page.width > 2 * kSheetPanel);
  CHECK(page.width < 3 * kSheetPanel);  // four pictures: two by two
  CHECK(readPng(files[1]).width == 64);
  CHECK(readFile(folder / "out/chart.csv").starts_with("curve,parameter,"));
  // Finished pictures are kept.
  fs::remove(folder / "out/chart.csv");
  shoot.panels();
  CHECK_FALSE(fs::exists(folder / "out/chart.csv"));

  const Scene plain = readScene(folder / "bounce.toml", {"panel=[]", "chart=[]"});
  CHECK(Shoot(plain, folder / "plain", studio).panels().empty());
}

TEST_CASE("sheets have few columns of large pictures") {
  const int columns[] = {1, 2, 3, 2, 3, 3, 4, 4, 3, 4, 4, 4};
  for (std::size_t n = 1; n <= 12; ++n) CHECK(columnsOf(n) == columns[n - 1]);
  CHECK(columnsOf(13) == 5);  // in four columns the last would stand alone
  CHECK(columnsOf(16) == 4);
}

TEST_CASE("a chart of a check that is none is refused at its place") {
  const Folder folder;
  writeFile(folder / "x.toml", kBounce);
  try {
    requireKnownChecks(readScene(folder / "x.toml", {"chart.0.error=first-hits"}));
    FAIL("not refused");
  } catch (const SceneError& error) {
    const std::string said = error.what();
    CHECK(said.find("unknown check 'first-hits', did you mean 'first-hit'?") != std::string::npos);
  }
}

TEST_CASE("a panel names what bends as it names bodies") {
  const Folder folder;
  writeFile(folder / "x.toml", R"(
[world]
duration = 0.1
[[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 1
[[cloth]]
name = "sheet"
columns = 3
rows = 3
size = [0.2, 0.2]
density = 0.2
stretch = 100
shear = 10
bend = 1e-5
position = [0, 1, 0]
[[panel]]
title = "a"
bodies = ["ball"]
[[panel]]
title = "b"
bodies = ["sheet"]
)");
  const Scene scene = readScene(folder / "x.toml");
  REQUIRE(scene.panels.size() == 2);
  CHECK(scene.world.bodies.size() == 10);
  CHECK(sceneOf(scene, scene.panels[0].variant).world.bodies.size() == 1);
  CHECK(sceneOf(scene, scene.panels[1].variant).world.bodies.size() == 9);
}

// Oracle: closed form. Each hit lies between two samples: there the ball is as high as its radius,
// and the energy above that falls to e² of itself at once. Allowed 1e-12; of what is lost 1e-9, as
// `course` brackets the hit.
TEST_CASE("a graph reaches the instants of hits, with the state before and after") {
  const std::string method = GENERATE("exact", "course");
  const std::string ball = R"([world]
duration = 2.0
method = "exact"
[materials.rubber]
density = 1000.0
restitution = 0.5
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
material = "rubber"
[[body]]
name = "ball"
shape = { sphere = 0.12 }
mass = 1.0
material = "rubber"
position = [0, 1, 0]
)";
  const std::string graph =
      "[[graph]]\nbody = \"ball\"\nshows = \"height\"\ncurves = [ { label = \"a\" } ]\n"
      "[[graph]]\nshows = \"energy\"\ncurves = [ { label = \"a\" } ]\n"
      "[[graph]]\nshows = \"values\"\naxis = \"v\"\nagainst = \"ball.y\"\nacross = \"y\"\n"
      "curves = [ { label = \"a\", value = \"ball.vy\" } ]\n";
  const Folder folder;
  writeFile(folder / "ball.toml", ball + graph);
  const Scene scene = readScene(folder / "ball.toml", {"world.method=" + method});
  const auto curveOf = [&](int k) {
    const GraphDef& def = scene.graphs[static_cast<std::size_t>(k)];
    return graphOf(def, runGraph(scene, def, [] {})).curves.front().points;
  };
  constexpr double kGravity = 9.81;  // m/s²
  const double hit = std::sqrt(2.0 * 0.88 / kGravity);
  const auto at = [&](const std::vector<Eigen::Vector2d>& points) {
    return std::find_if(points.begin(), points.end(),
                        [&](const auto& point) { return point.x() > hit - 1e-9; });
  };
  const auto heights = curveOf(0), energies = curveOf(1);
  CHECK(at(heights)->y() == Approx(0.12).margin(1e-12));
  const auto before = at(energies);
  CHECK(before->y() == Approx(kGravity).epsilon(1e-12));
  CHECK((before + 1)->x() == Approx(hit).margin(1e-9));
  CHECK((before + 1)->y() == Approx(kGravity * (0.12 + 0.25 * 0.88)).epsilon(1e-9));
  // In the plane of place and velocity the ball turns at the floor, from 2gh to half of it.
  const auto phase = curveOf(2);
  const auto struck = std::find_if(phase.begin(), phase.end(),
                                   [](const auto& point) { return point.x() < 0.12 + 1e-9; });
  REQUIRE(struck != phase.end());
  CHECK(struck->y() == Approx(-kGravity * hit).epsilon(1e-9));
  CHECK((struck + 1)->y() == Approx(0.5 * kGravity * hit).epsilon(1e-9));
}

TEST_CASE("heights of less than ten centimetres are drawn in millimetres") {
  const GraphDef graph;  // of heights
  GraphSeries series;
  series.points = {{0.0, 0.02}, {1.0, -0.03}};
  const Chart low = graphOf(graph, {series});
  CHECK(low.y.caption == "height / mm");
  CHECK(low.curves[0].points[1].y() == -30.0);
  series.points.back().y() = 0.11;
  const Chart high = graphOf(graph, {series});
  CHECK(high.y.caption == "height / m");
  CHECK(high.curves[0].points[0].y() == 0.02);
}
