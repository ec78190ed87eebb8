// What `tumble converge` prints and leaves behind.
#include "tests/catch.h"
#include "tests/program/program.h"

namespace {

const std::string kFall = R"([world]
duration = 0.5
[[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 1.0
velocity = [1, 2, 3]
)";

}  // namespace

TEST_CASE("converge prints a table for each instant and leaves numbers and a figure") {
  const Folder scratch;
  scratch.file("fall.toml", kFall);
  scratch.file("gnuplot",
               "#!/bin/sh\necho '</svg>' >speed.svg\nprintf 'IEND\\256B\\140\\202' >speed.png\n");
  const Outcome outcome = tumbleRun(scratch, "converge fall.toml --at 0.25,0.5 -o out",
                                    "chmod +x gnuplot; export PATH=$PWD:$PATH");
  CAPTURE(outcome.out, outcome.err);
  CHECK(outcome.code == 0);
  for (const char* text : {"t = 0.25 s", "t = 0.5 s", "course: rounding", "exact: no step",
                           "stepping: rounding", "off exact", "out/speed.svg"})
    CHECK(outcome.out.find(text) != std::string::npos);
  for (const char* file : {"out/converge.csv", "out/speed.csv", "out/speed.gp", "out/speed.svg"})
    CHECK(std::filesystem::exists(scratch / file));
}

TEST_CASE(
    "without gnuplot converge prints its tables, keeps its numbers and says how to draw them") {
  const Folder scratch;
  scratch.file("fall.toml", kFall);
  const Outcome outcome =
      tumbleRun(scratch, "converge fall.toml --at 0.5 -o out", "export PATH=/nowhere");
  CHECK(outcome.code == 0);
  CHECK(outcome.lines() == 0);
  CHECK(outcome.out.find("no out/speed.svg: gnuplot draws it and is not here; install "
                         "gnuplot-nox, then `gnuplot speed.gp` in out\n") != std::string::npos);
  CHECK(outcome.out.find("t = 0.5 s") != std::string::npos);
  for (const char* file : {"out/converge.csv", "out/speed.csv", "out/speed.gp"})
    CHECK(std::filesystem::exists(scratch / file));
  CHECK(tumbleRun(scratch, "doctor", "export PATH=/nowhere")
            .out.find("needed by the figures of report and converge") != std::string::npos);
}

TEST_CASE("converge refuses what it cannot do in one line") {
  struct Case {
    std::string arguments;
    int code;
    std::string says;
  };
  const Case wrong = GENERATE(
      Case{"converge", 2, "SCENE"}, Case{"converge nothing.toml", 5, "nothing.toml"},
      Case{"converge fall.toml --at 0.5,0.2", 2, "--at 0.5,0.2: expected ascending instants"},
      Case{"converge fall.toml --at 7", 2, "up to the duration of 0.5 s"},
      Case{"converge fall.toml --budget no", 2, "--budget"},
      Case{"converge fall.toml --set course.step=-1", 3, "expected a number"});
  const Folder scratch;
  scratch.file("fall.toml", kFall);
  const Outcome outcome = tumbleRun(scratch, wrong.arguments);
  CAPTURE(wrong.arguments, outcome.err);
  CHECK(outcome.code == wrong.code);
  CHECK(outcome.says(wrong.says));
  CHECK(outcome.lines() == 1);
  CHECK(filesBelow(scratch / "out") == 0);
}
