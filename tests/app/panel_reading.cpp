// [[panel]] and [[chart]]: what they say, what is refused, and what a variant leaves of a scene.
#include "app/scene/scene.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

// Twenty lines; the panels of each test come behind.
const std::string kTwo = R"([world]
duration = 2.0
[[body]]
name = "left"
shape = { sphere = 0.1 }
mass = 1.0
[[array]]
name = "right"
kind = "row"
count = 2
step = [1, 0, 0]
body = { shape = { sphere = 0.1 }, position = [3, 0, 0], mass = 2.0 }
[[force]]
kind = "spring"
a = "left"
b = "right.1"
stiffness = 1.0
[[force]]
kind = "wind"
force = [1, 0, 0]
)";

std::string panelComplaint(const std::string& text,
                           const std::vector<std::string>& overrides = {}) {
  try {
    parseScene(kTwo + text, "s.toml", overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("panels and charts keep what they say") {
  const Scene scene = parseScene(kTwo + R"(
[[panel]]
title = "slow"
subtitle = "half of it"
picture = "still"
at = 1.5
set = { "world.duration" = 1.5, "body.left.shape" = { box = [1, 2, 3] } }
[[panel]]
bodies = ["right"]
[[chart]]
title = "error"
error = "arcs"
row = "arc / m"
along = "course.step"
values = [0.1, 0.01]
floor = 1e-15
set = { "world.gravity" = [0, 0, 0] }
curves = [ { label = "E", set = { "course.integrator" = "euler" } }, { label = "F", values = [1e-3] },
           { label = "G", along = "course.tolerance", values = [1e-6] } ]
)",
                                 "s.toml");
  REQUIRE(scene.panels.size() == 2);
  CHECK(scene.panels[0].variant.title == "slow");
  CHECK(scene.panels[0].subtitle == "half of it");
  CHECK(scene.panels[0].picture == "still");
  CHECK(scene.panels[0].at == 1.5);
  REQUIRE(scene.panels[0].variant.set.size() == 2);
  CHECK(scene.panels[0].variant.set[0].text == "body.left.shape={\"box\" = [1, 2, 3]}");
  CHECK(scene.panels[0].variant.set[1].text == "world.duration=1.5");
  CHECK(scene.panels[1].picture == "strobe");
  CHECK(scene.panels[1].variant.bodies == std::vector<std::string>{"right"});

  REQUIRE(scene.charts.size() == 1);
  const ChartDef& chart = scene.charts[0];
  CHECK(chart.error == "arcs");
  CHECK(chart.row == "arc / m");
  CHECK(chart.cost == "evaluations");
  CHECK(chart.floor == 1e-15);
  CHECK(chart.along.values == std::vector<std::string>{"0.1", "0.01"});
  REQUIRE(chart.curves.size() == 3);
  CHECK(chart.curves[0].variant.title == "E");
  CHECK(chart.curves[0].along.values == chart.along.values);
  CHECK(chart.curves[1].along.values == std::vector<std::string>{"0.001"});
  CHECK(chart.curves[1].along.parameter == "course.step");
  CHECK(chart.curves[2].along.parameter == "course.tolerance");
}

TEST_CASE("a variant is the scene with its settings, its bodies and the forces between them") {
  const std::string text = kTwo + "[[panel]]\n[sweep]\nparameter = \"title\"\nvalues = [1]\n";
  const auto scene = [&](const Variant& variant, const std::vector<std::string>& overrides = {}) {
    return parseScene(text, "s.toml", overrides, &variant);
  };
  const Scene left = scene({"", {}, {"left"}});
  REQUIRE(left.world.bodies.size() == 1);
  CHECK(left.world.bodies[0].name == "left");
  CHECK(left.world.forces.size() == 1);  // the wind blows on, the spring has lost an end
  CHECK(left.panels.empty());
  CHECK_FALSE(left.sweep);

  const Scene right = scene({"", {}, {"right"}});
  REQUIRE(right.world.bodies.size() == 2);
  CHECK(right.world.bodies[1].name == "right.1");
  CHECK(scene({}).world.forces.size() == 2);

  // The variant has the last word, and a table takes the place of a table.
  const Scene set = scene({"", {{"body.left.shape={ box = [2, 2, 2] }", {}}}, {}},
                          {"body.left.shape={ sphere = 9 }", "world.duration=1"});
  CHECK(std::get<Box>(set.world.bodies[0].shape).half == Vec3(1.0, 1.0, 1.0));
  CHECK(set.world.duration == 1.0);
  CHECK(set.line.find("world.duration=1 body.left.shape={ box") != std::string::npos);
}

TEST_CASE("a wrong panel or chart is refused at its place, with what is meant") {
  struct Wrong {
    std::string text, place, says;
  };
  const std::string chart =
      "[[chart]]\nerror = \"arcs\"\nalong = \"course.step\"\nvalues = [1]\ncurves = [{ label = "
      "\"E\" }]\n";
  const auto spoilt = [&](const std::string& what, const std::string& by) {
    std::string text = chart;
    return text.replace(text.find(what), what.size(), by);
  };
  REQUIRE(panelComplaint(chart).empty());
  const Wrong wrong = GENERATE_REF(
      Wrong{"[[panel]]\ntitel = \"a\"", "22:1", "panel.0.titel: unknown key, did you mean 'title'"},
      Wrong{"[[panel]]\npicture = \"stil\"", "22:11", "did you mean 'still'"},
      Wrong{"[[panel]]\npicture = \"still\"\nat = -1", "23:6", "panel.0.at: expected a number [s]"},
      Wrong{"[[panel]]\nat = 1", "22:6", "add picture = \"still\""},
      Wrong{"[[panel]]\npicture = \"still\"\nat = 3", "21:1", "lasts from 0 to 2"},
      Wrong{"[[panel]]\nbodies = [\"lft\"]", "22:10", "[[array]] 'lft', did you mean 'left'"},
      Wrong{"[[panel]]\nbodies = \"left\"", "22:10", "expected a list of strings"},
      Wrong{"[[panel]]\nset = 3", "22:7", "expected a table like"},
      Wrong{"[[panel]]\nset = { course.step = 3 }", "22:9", "replaces all of course"},
      Wrong{"[[panel]]\nset = { \"a..b\" = 3 }", "22:9", "is no key of a scene"},
      Wrong{"[[panel]]\ntitle = \"P\"\nset = { \"course.stp\" = 3 }", "23:24",
            "course.stp: unknown key, did you mean 'step'? Valid: "},
      Wrong{"[[panel]]\ntitle = \"P\"\nset = { \"course.stp\" = 3 }", "23:24",
            "(as set in [[panel]] 'P')"},
      Wrong{"[[panel]]\nset = { \"course.step\" = -3 }", "22:25", "expected a number [s]"},
      Wrong{"[panel]\ntitle = \"a\"", "21:1", "expected an array of tables, [[panel]]"},
      Wrong{spoilt("error = \"arcs\"", ""), "21:1", "chart.0.error: expected the name of a check"},
      Wrong{spoilt("along = \"course.step\"", ""), "21:1", "chart.0.along: expected a key"},
      Wrong{spoilt("values = [1]", "values = []"), "24:10", "expected a list of 1 to 10000"},
      Wrong{spoilt("curves = [{ label = \"E\" }]", ""), "21:1",
            "chart.0.curves: expected 1 to 100 tables"},
      Wrong{spoilt("label", "lable"), "25:13", "unknown key, did you mean 'label'"},
      Wrong{spoilt("label = \"E\"", ""), "25:11",
            "chart.0.curves.0.label: expected the curve's name"},
      Wrong{spoilt("\"E\"", "\"\""), "25:21", "chart.0.curves.0.label: expected the curve's name"},
      Wrong{spoilt("\"E\"", "\"E\\nF\""), "25:21", "label: expected one line without control"},
      Wrong{spoilt("error", "title = \"a\\u001bb\"\nerror"), "22:9",
            "chart.0.title: expected one line"},
      Wrong{spoilt("error", "subtitle = \"a\\nb\"\nerror"), "22:12", "subtitle: expected one line"},
      Wrong{"[[panel]]\nsubtitle = \"a\\tb\"", "22:12", "panel.0.subtitle: expected one line"},
      Wrong{"[[panel]]\nbodies = []", "22:10", "panel.0.bodies: expected at least one name"},
      Wrong{spoilt("error", "bodies = []\nerror"), "22:10", "chart.0.bodies: expected at least"},
      Wrong{spoilt("}]", "}]\ncost = \"time\""), "26:8", "valid: evaluations, cpu"},
      Wrong{spoilt("}]", "}]\nfloor = 0"), "26:9", "chart.0.floor: expected a number > 0"},
      Wrong{spoilt("course.step", "course.stp"), "23:9", "(as set in [[chart]] 'E')"});
  CAPTURE(wrong.text);
  const std::string said = panelComplaint(wrong.text);
  CAPTURE(said);
  CHECK(said.starts_with("s.toml:" + wrong.place + ": error: "));
  CHECK(said.find(wrong.says) != std::string::npos);
}

TEST_CASE("a still outlasts its scene where --set cuts the run short") {
  CHECK(panelComplaint("[[panel]]\npicture = \"still\"\nat = 1.5", {"world.duration=1"}).empty());
}
