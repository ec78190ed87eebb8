// What `tumble report` leaves behind, with gnuplot and without.
#include "tests/catch.h"
#include "tests/program/program.h"

namespace {

const std::string kOrbit = R"([world]
gravity = [0, 0, 0]
duration = 0.5
[[body]]
shape = "particle"
mass = 1.0
position = [1, 0, 0]
velocity = [0, 1, 0]
[[force]]
kind = "field"
axis = [0, 0, 1]
rate = 1.0
)";
const std::string kChart = R"([[chart]]
title = "An orbit"
error = "orbit"
along = "course.step"
values = [0.1, 0.05]
curves = [ { label = "RK4" } ]
)";

std::string with(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

}  // namespace

TEST_CASE("without gnuplot the numbers are there, and one line says what to install") {
  const Folder scratch;
  scratch.file("orbit.toml", kOrbit + kChart);
  const Outcome outcome =
      tumbleRun(scratch, "report orbit.toml -o out --budget 0", "export PATH=/nowhere");
  CHECK(outcome.code == 5);
  CHECK(outcome.says("install the package gnuplot-nox"));
  for (const char* file :
       {"out/orbit.csv", "out/orbit.gp", "out/table.csv", "out/table.md", "out/index.html"})
    CHECK(std::filesystem::exists(scratch / file));
}

TEST_CASE("a report of a scene without a chart is refused") {
  const Folder scratch;
  scratch.file("bare.toml", kOrbit);
  const Outcome outcome = tumbleRun(scratch, "report bare.toml -o out");
  CHECK(outcome.code == 3);
  CHECK(outcome.says("bare.toml: error: there is no [[chart]] in it"));
}

TEST_CASE("scenes of the same file name keep their numbers apart") {
  const Folder scratch;
  std::filesystem::create_directories(scratch / "a");
  std::filesystem::create_directories(scratch / "b");
  scratch.file("a/st.toml", kOrbit + with(kChart, "RK4", "first"));
  scratch.file("b/st.toml", kOrbit + with(kChart, "RK4", "second"));
  tumbleRun(scratch, "report a/st.toml b/st.toml -o out --budget 0", "export PATH=/nowhere");
  CHECK(textOf(scratch / "out/st.csv").find("first") != std::string::npos);
  CHECK(textOf(scratch / "out/st-2.csv").find("second") != std::string::npos);
}

TEST_CASE("figures that gnuplot leaves out or unfinished end with 5, and none of them is left") {
  struct Gnuplot {
    std::string script, spoils;  ///< what it does; the figure that it is blamed for
  };
  const std::string svg = "echo '</svg>' >orbit.svg\n";
  const std::string png = "printf 'IEND\\256B\\140\\202' >orbit.png\n";
  const Gnuplot gnuplot = GENERATE_COPY(
      Gnuplot{svg + png, ""}, Gnuplot{"exit 0", "orbit.svg"}, Gnuplot{png, "orbit.svg"},
      Gnuplot{png + "echo '<svg>' >orbit.svg", "orbit.svg"}, Gnuplot{svg, "orbit.png"},
      Gnuplot{svg + "echo PNG >orbit.png", "orbit.png"});
  CAPTURE(gnuplot.script);
  const Folder scratch;
  scratch.file("orbit.toml", kOrbit + kChart);
  scratch.file("gnuplot", "#!/bin/sh\n" + gnuplot.script);
  // A figure of an earlier run does not count.
  const Outcome outcome = tumbleRun(
      scratch, "report orbit.toml -o out --budget 0",
      "mkdir out; echo '</svg>' >out/orbit.svg; chmod +x gnuplot; export PATH=$PWD:$PATH");
  CAPTURE(outcome.err);
  const bool whole = gnuplot.spoils.empty();
  CHECK(outcome.code == (whole ? 0 : 5));
  CHECK(outcome.lines() == (whole ? 0 : 1));
  if (!whole) CHECK(outcome.says("out/" + gnuplot.spoils));
  CHECK(std::filesystem::exists(scratch / "out/orbit.svg") == whole);
  CHECK(std::filesystem::exists(scratch / "out/orbit.png") == whole);
}

TEST_CASE("gnuplot runs nothing that a scene's texts say") {
  if (std::system("command -v gnuplot >/dev/null") != 0) return;
  const Folder scratch;
  const std::string label = R"('''`touch made` $(touch made) "a" 'b' @c \n {d <e> &''')";
  scratch.file("orbit.toml", kOrbit + with(with(kChart, "\"RK4\"", label), "\"An orbit\"", label));
  const Outcome outcome = tumbleRun(scratch, "report orbit.toml -o out --budget 0");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK_FALSE(std::filesystem::exists(scratch / "out/made"));
  const std::string figure = textOf(scratch / "out/orbit.svg");
  CHECK(figure.find(R"(`touch made` $(touch made) "a" 'b' @c \n {d &lt;e> &amp;)") !=
        std::string::npos);
}

TEST_CASE("a chart without an error that can be drawn is refused where its check is named") {
  const std::string free = kOrbit.substr(0, kOrbit.find("[[force]]"));
  struct Case {
    std::string scene, says;
  };
  const Case chart = GENERATE_COPY(
      Case{free + kChart, "the check 'orbit' finds nothing in these runs"},
      Case{with(free, "\"particle\"", "{ sphere = 0.5 }") + with(kChart, "\"orbit\"", "\"weight\""),
           "the check 'weight' finds no error in these runs"});
  const Folder scratch;
  scratch.file("orbit.toml", chart.scene);
  const Outcome outcome = tumbleRun(scratch, "report orbit.toml -o out --budget 0");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 3);
  CHECK(outcome.lines() == 1);
  CHECK(outcome.says("orbit.toml:11:9: error: chart[0].error: " + chart.says));
}
