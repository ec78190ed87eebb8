// What pictures draw to explain: arrows with names, contacts, states, diagrams, values against
// time.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "app/claim/verdict.h"
#include "app/panel/graph_run.h"
#include "app/present/arrows.h"
#include "app/present/digits.h"
#include "app/present/present.h"
#include "app/present/state_picture.h"
#include "app/scene/demos.h"
#include "tests/catch.h"

using namespace tumble;
namespace fs = std::filesystem;

namespace {

const std::string kBallOnFloor = R"([world]
method = "course"
duration = 0.5
[course]
step = 0.01
[materials.rubber]
density = 1000.0
restitution = 1.0
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[body]]
name = "ball"
shape = { sphere = 0.1 }
material = "rubber"
position = [0, 0.3, 0]
velocity = [1, 0, 0]
[show]
)";

Picture pictureAt(const std::string& text, double t,
                  const std::vector<std::string>& overrides = {}) {
  const Scene scene = parseScene(text, "scene", overrides);
  const Recording recording = record(scene, 60.0);
  return Presenter(scene, recording).still(t);
}

const Label* labelled(const Picture& picture, const std::string& part) {
  for (const Label& label : picture.labels)
    if (label.text.find(part) != std::string::npos) return &label;
  return nullptr;
}

// The arrow whose tip a name stands at.
Vec3 arrowNamed(const Picture& picture, const std::string& name) {
  const Label* label = labelled(picture, name);
  REQUIRE(label);
  for (const Arrow& arrow : picture.arrows)
    if (arrow.tip == *label->anchor) return arrow.tip - arrow.base;
  FAIL("no arrow at " << name);
  return Vec3::Zero();
}

}  // namespace

TEST_CASE("v and F point as the body moves and is pulled, and the slots say so in numbers") {
  const Picture picture = pictureAt(
      kBallOnFloor + "motion = true\ndiagram = \"state\"\nslots = [\"x\", \"v\", \"?\"]\n", 0.1);
  // t = 0.1 s: v = (1, −0.981, 0) m/s, F = m g.
  CHECK(arrowNamed(picture, "v").normalized().dot(Vec3(1.0, -0.981, 0.0).normalized()) ==
        Approx(1.0).epsilon(1e-9));
  CHECK(arrowNamed(picture, "F").normalized().dot(-Vec3::UnitY()) == Approx(1.0).epsilon(1e-9));
  CHECK(labelled(picture, "1.00  −0.98  0.00 m/s"));
  CHECK(labelled(picture, "0.00  −9.81  0.00 m/s²"));
  CHECK(labelled(picture, "?"));
}

// Oracle: τ = Σ (p − x) × f by hand. f₁ = 3 N up at 0.2 m to the left: τ = −0.6 N m about Z.
TEST_CASE("forces have their sum at the centre of mass and the torque of their levers") {
  const std::string scene = R"([world]
gravity = [0, 0, 0]
duration = 0.1
[[body]]
name = "block"
shape = { box = [0.4, 0.2, 0.2] }
mass = 5.0
[[force]]
kind = "point"
body = "block"
point = [-0.2, -0.1, 0]
force = [0, 3, 0]
[[force]]
kind = "point"
body = "block"
point = [-0.2, 0.0, 0]
force = [4, 0, 0]
[show]
forces = true
resultant = true
)";
  const Picture picture = pictureAt(scene, 0.0);
  CHECK(arrowNamed(picture, "F = ").normalized().dot(Vec3(0.8, 0.6, 0.0)) ==
        Approx(1.0).epsilon(1e-12));
  CHECK(arrowNamed(picture, "τ = ").normalized().dot(-Vec3::UnitZ()) == Approx(1.0).epsilon(1e-12));
  CHECK(labelled(picture, "f₂"));
}

TEST_CASE("a contact is colliding, resting or separating by the sign of n·ṗ") {
  const auto [vy, kind] = GENERATE(std::pair(-1.0, "colliding"), std::pair(0.0, "resting"),
                                   std::pair(1.0, "separating"));
  const Scene scene = parseScene(
      kBallOnFloor + "contact_velocities = true\n", "scene",
      {"body.ball.position=[0, 0.1, 0]", fmt::format("body.ball.velocity=[0.5, {}, 0]", vy)});
  const Picture picture = statePicture(scene, checkedStart(scene));
  REQUIRE_FALSE(picture.marks.empty());
  CHECK(picture.marks.front().lines.front().find(kind) == 0);
}

// Steps leave 3.2e-4 m/s along the normal here.
TEST_CASE("what slides on a floor rests on it, whatever a step leaves along the normal") {
  const Picture picture = pictureAt(R"([world]
duration = 0.5
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
friction = 0.3
[[body]]
name = "board"
shape = { box = [4.0, 1.6, 1.0] }
mass = 10.0
position = [0, 0.8, 0]
friction = 0.3
[[force]]
kind = "point"
body = "board"
point = [-1.5, 0.3, 0.5]
force = [60, 20, 0]
[[force]]
kind = "point"
body = "board"
point = [1.5, -0.2, 0.5]
force = [-30, 40, 0]
[show]
contact_velocities = true
)",
                                    0.3);
  REQUIRE(picture.marks.size() == 1);
  CHECK(picture.marks.front().lines.front() == "resting: n·ṗ = 0");
}

// Oracle: its own velocity, 1 m/s along n. No method keeps a contact that ends as time begins.
TEST_CASE("what separates as time begins says so in the first image of its run") {
  const std::string method = GENERATE("course", "exact", "stepping");
  const Picture picture =
      pictureAt(kBallOnFloor + "contact_velocities = true\n", 0.0,
                {"body.ball.position=[0, 0.1, 0]", "body.ball.velocity=[0, 1, 0]",
                 "world.method=\"" + method + "\""});
  REQUIRE(picture.marks.size() == 1);
  CHECK(picture.marks.front().lines.front().find("separating") == 0);
  CHECK(picture.marks.front().lines.back() == "1.000 m/s");
  CHECK(arrowNamed(picture, "ṗ").normalized().y() == Approx(1.0));
}

TEST_CASE("the flow chart is lit where the instant is: flight, impact, rest") {
  const std::string scene = kBallOnFloor + "diagram = \"flow\"\n";
  const auto lit = [&](double t, const std::vector<std::string>& overrides = {}) {
    const Scene changed = parseScene(scene, "scene", overrides);
    const Recording recording = record(changed, 60.0);
    std::string bold;
    for (const Label& label : Presenter(changed, recording).still(t).labels)
      if (label.bold) bold += (bold.empty() ? "" : " ") + label.text;
    return bold;
  };
  CHECK(lit(0.1) == "update the state");
  CHECK(lit(0.2167) == "respond: impulses");  // touches at √(2 · 0.2/9.81) = 0.2019 s
  CHECK(lit(0.2, {"body.ball.position=[0, 0.1, 0]"}) == "forces at rest");
}

TEST_CASE("a spring below a ball is as much shorter as the ball has sunk in") {
  const Scene scene = parseScene(kBallOnFloor + "springs = true\n", "scene",
                                 {"course.contact=\"penalty\"", "course.stiffness=20000.0"});
  const Recording recording = record(scene, 240.0);
  const Presenter presenter(scene, recording);
  const auto topAt = [&](int k) {
    double top = -1.0;
    for (const Polyline& line : presenter.image(k).lines)
      for (const Eigen::Vector3d& point : line.points) top = std::max(top, point.y());
    return top;
  };
  bool sunk = false;
  for (int k = 0; k < presenter.count(); ++k) {
    const double lowest = recording.samples[static_cast<std::size_t>(k)].bodies[1].x.y() - 0.1;
    CHECK(topAt(k) == Approx(std::min(0.0, lowest)).margin(1e-12));
    sunk = sunk || lowest < -0.01;
  }
  CHECK(sunk);
}

TEST_CASE("a panel shows a start that no run can begin with, in red") {
  const Scene scene = parseScene(kBallOnFloor, "scene", {"body.ball.position=[0, 0.05, 0]"});
  CHECK_THROWS_AS(makeWorld(scene), SceneError);
  const Picture picture = statePicture(scene, checkedStart(scene));
  CHECK(labelled(picture, "POSITIONS NOT OK"));
}

// They are about runs, and its verdict stands where they would.
TEST_CASE("the picture of a start has no words on what is expected of a run") {
  const std::string claim = "[[expect]]\nvalue = \"ball.y\"\nequals = 0.1\n";
  const std::string free = kBallOnFloor.substr(0, kBallOnFloor.find("[show]"));
  const Scene scene = parseScene(free + claim, "scene"), plain = parseScene(free, "scene");
  const Picture with = statePicture(scene, checkedStart(scene));
  const Picture without = statePicture(plain, checkedStart(plain));
  CHECK(labelled(with, "positions, velocities and accelerations are ok"));
  CHECK(with.labels.size() == without.labels.size());
  CHECK(with.lines.size() == without.lines.size());
}

// Oracle: closed form: vx = 1 m/s, so py/px = −g x. Measured 2e-15, allowed 1e-12.
TEST_CASE("a graph of values follows its formula, against another in place of the time") {
  const fs::path file =
      fs::temp_directory_path() / ("tumble-" + std::to_string(::getpid()) + ".toml");
  std::ofstream(file) << kBallOnFloor << "floor = true\n"
                      << R"(
[[graph]]
shows = "values"
against = "ball.x"
set = { "world.duration" = 0.2, "image.rate" = 10.0 }
curves = [{ label = "a", value = "ball.py / ball.px" }, { label = "b", value = "steps" }]
)";
  const Scene scene = readScene(file.string());
  const std::vector<GraphSeries> series = runGraph(scene, scene.graphs.front(), [] {});
  fs::remove(file);
  REQUIRE(series.size() == 2);
  REQUIRE(series[0].points.size() == 3);
  for (const Eigen::Vector2d& point : series[0].points)
    CHECK(point.y() == Approx(-9.81 * point.x()).margin(1e-12));
  CHECK(series[0].points.back().x() == Approx(0.2).epsilon(1e-12));
  CHECK(series[1].points.front().y() == 0.0);
  CHECK(series[1].points.back().y() >= 20.0);
}

TEST_CASE("values that are no formula, or without one, are refused at their place") {
  const auto complaint = [](const std::string& graph) {
    try {
      requireKnownChecks(parseScene(kBallOnFloor + "floor = true\n[[graph]]\n" + graph, "s.toml"));
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(complaint("shows = \"values\"\ncurves = [{ label = \"a\", value = \"ball.pq\" }]\n")
            .find("unknown quantity") != std::string::npos);
  CHECK(complaint("shows = \"values\"\ncurves = [{ label = \"a\" }]\n").find("formula") !=
        std::string::npos);
  CHECK(
      complaint("body = \"ball\"\ncurves = [{ label = \"a\", value = \"t\" }]\n").find("values") !=
      std::string::npos);
  CHECK(complaint("shows = \"values\"\ncurves = [{ label = \"a\", value = \"steps\" }]\n").empty());
}

// A claim about a body and words beside it go with it, so that a panel of the others can be drawn.
TEST_CASE("a panel without a body is free of what is expected and said of it") {
  const std::string text = kBallOnFloor + R"(floor = true
[[expect]]
value = "ball.y"
equals = 1.0
[[text]]
text = "a ball"
body = "ball"
[[body]]
name = "other"
shape = { sphere = 0.1 }
mass = 1.0
position = [3, 1, 0]
[[panel]]
bodies = ["floor", "other"]
)";
  const Scene scene = parseScene(text, "scene");
  CHECK((scene.expects.size() == 1 && scene.texts.size() == 1));
  const Scene other = parseScene(text, "scene", {}, &scene.panels.front().variant);
  CHECK((other.expects.empty() && other.texts.empty()));
}

TEST_CASE("numbers have four digits, zeros too") {
  CHECK(fourDigits(9.81) == "9.810");
  CHECK(fourDigits(98.1) == "98.10");
  CHECK(fourDigits(-245.25) == "−245.2");
  CHECK(fourDigits(1177.2) == "1177");
  CHECK(fourDigits(25184.0) == "25180");
  CHECK(fourDigits(2.4525e9) == "2.452 × 10⁹");
  CHECK(fourDigits(-9.81e-7) == "−9.810 × 10⁻⁷");
}

TEST_CASE("numbers of claims are written as they are printed") {
  CHECK(printed(0.00598151, 6) == "0.00598151");
  CHECK(printed(1e-9, 6) == "10⁻⁹");
  CHECK(printed(-3.31e-15, 2) == "−3.3 × 10⁻¹⁵");
  CHECK(printed(2.5e12, 6) == "2.5 × 10¹²");
  CHECK(printed(0.0, 6) == "0");
}

// What the lectures ask or show without a number.
const std::set<std::string> kAsked = {"One solver for particles and bodies",
                                      "What is a rigid body?",
                                      "Centre of mass of points",
                                      "Why quaternions",
                                      "What keeps its momentum",
                                      "Never by hand",
                                      "Which contacts are possible?",
                                      "Positions not OK",
                                      "Velocities not OK",
                                      "Accelerations not OK",
                                      "A contact that parts",
                                      "Velocities of points",
                                      "Impulse",
                                      "Boxes at root, middle and leaf",
                                      "A particle between two planes",
                                      "Rigid bodies: same thing",
                                      "Wind",
                                      "Path of a brick",
                                      "Cloth on a solid",
                                      "New contacts: generally inside",
                                      "Exact constraints for cloth and solids",
                                      "Fur on a solid",
                                      "What stands for a deformable body?",
                                      "Which forces resist deformation?"};

// The slides of the lectures that show something: all but titles, derivations in the notes and
// code.
TEST_CASE("every slide with something to see has a picture of a demo, and no other is named") {
  std::set<std::string> named;
  for (const std::string& name : demoNames()) {
    const Scene scene = readScene(scenePath(name));
    const auto take = [&](const std::vector<std::string>& slides) {
      named.insert(slides.begin(), slides.end());
    };
    take(scene.slides);
    for (const PanelDef& panel : scene.panels) take(panel.slides);
    for (const GraphDef& graph : scene.graphs) take(graph.slides);
    for (const ChartDef& chart : scene.charts) take(chart.slides);
  }
  const std::set<int> bare[] = {{1, 18, 23, 46, 56}, {1, 18, 28}, {1, 16, 19, 20, 21, 22, 23}};
  const std::pair<std::string, int> series[] = {{"SD", 57}, {"SF", 28}, {"SH", 28}};
  std::set<std::string> expected = kAsked;
  for (std::size_t k = 0; k < 3; ++k)
    for (int n = 1; n <= series[k].second; ++n)
      if (!bare[k].contains(n)) expected.insert(series[k].first + std::to_string(n));
  for (const std::string& slide : expected) {
    INFO(slide);
    CHECK(named.contains(slide));
  }
  for (const std::string& slide : named) {
    INFO(slide);
    CHECK(expected.contains(slide));
  }
}
