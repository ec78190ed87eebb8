// Goldens of a user's own scenes: kept in a folder of his, held on every context, read by programs.
#include "tests/catch.h"
#include "tests/program/program.h"

namespace {

// A wedge read from a file beside the scene tumbles past a ball.
const std::string kWedgeAndBall = R"([world]
duration = 0.4
[[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 1.0
position = [0, 0.3, 0]
[[body]]
name = "wedge"
shape = { mesh = "wedge.obj" }
mass = 2.0
position = [0.5, 2.0, 0]
angular_velocity = [1, 2, 3]
)";
const std::string kWedge = R"(v 0 0 0
v 0.4 0 0
v 0 0.4 0
v 0 0 0.4
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
)";

// The scene with the ball at another height.
std::string moved(const std::string& text, const std::string& by) {
  std::string changed = text;
  return changed.replace(changed.find("0.3, 0]"), 7, by);
}

}  // namespace

TEST_CASE("goldens of one's own scene hold with OSMesa and EGL, and a change of it fails") {
  const Folder scratch;
  scratch.file("wedge.obj", kWedge);
  scratch.file("mine.toml", kWedgeAndBall);
  const Outcome first = tumbleRun(scratch, "golden --folder kept --update mine.toml");
  CHECK(first.code == 0);
  CHECK(holds(first.out, "new     mine                 start"));
  CHECK(holds(first.out, "kept: 5 goldens: 5 new\n"));
  CHECK(holds(tumbleRun(scratch, "golden --folder kept --update mine.toml").out,
              "kept: 5 goldens: 5 ok\n"));
  const std::string told = tumbleRun(scratch, "golden --folder kept --update --json mine.toml").out;
  CHECK(holds(told, "\"word\": \"ok\""));
  CHECK_FALSE(holds(told, "\"word\": \"new\""));
  CHECK(std::filesystem::exists(scratch / "kept/mine/start.png"));
  CHECK(std::filesystem::exists(scratch / "kept/mine/numbers.csv"));

  // Two folders at once, by another context.
  std::filesystem::copy(scratch.path / "kept", scratch.path / "second",
                        std::filesystem::copy_options::recursive);
  const Outcome again =
      tumbleRun(scratch, "golden --folder kept --folder second mine.toml --junit j.xml",
                "export TUMBLE_GL=egl");
  CAPTURE(again.err, again.out);
  CHECK(again.code == 0);
  CHECK(holds(again.out, "kept: 5 goldens: 5 pass, 5 equal to the last bit"));
  CHECK(holds(again.out, "second: 5 goldens: 5 pass, 5 equal to the last bit"));
  CHECK(holds(textOf(scratch.path / "j.xml"), "tests=\"10\" failures=\"0\""));
  CHECK_FALSE(std::filesystem::exists(scratch / "out"));

  scratch.file("mine.toml", moved(kWedgeAndBall, "0.31, 0]"));
  const Outcome changed =
      tumbleRun(scratch, "golden --folder kept mine.toml --junit ci/results/j.xml");
  CHECK(changed.code == 1);
  CHECK_FALSE(holds(changed.out, "; actual: "));  // drawn by the same program: no word on it
  const std::string advice = "tumble golden --folder kept --update mine.toml";
  CHECK(holds(changed.out, "`" + advice + "` accepts what is drawn now"));
  CHECK(holds(textOf(scratch.path / "ci/results/j.xml"), "<failure message="));
  const std::string report = textOf(scratch.path / "out/golden/kept/report.html");
  CHECK(holds(report, advice));
  CHECK(holds(report, "actual minus expected"));

  // What passes again leaves no report of an earlier failure.
  scratch.file("mine.toml", kWedgeAndBall);
  CHECK(tumbleRun(scratch, "golden --folder kept mine.toml").code == 0);
  CHECK(filesBelow(scratch.path / "out") == 0);
}

TEST_CASE("two processes that enter goldens into one folder both find theirs") {
  const Folder scratch;
  scratch.file("wedge.obj", kWedge);
  scratch.file("one.toml", kWedgeAndBall);
  scratch.file("two.toml", moved(kWedgeAndBall, "0.4, 0]"));
  const std::string update = std::string("'") + TUMBLE_PROGRAM + "' golden --folder kept --update ";
  const Outcome held =
      tumbleRun(scratch, "golden --folder kept one.toml two.toml",
                "(" + update + "one.toml & " + update + "two.toml; wait) >/dev/null");
  CAPTURE(held.out, held.err);
  CHECK(held.code == 0);
}

TEST_CASE("goldens of scenes that cannot be held are refused in one line, and none is begun") {
  struct Slip {
    std::string arguments;
    int code;
    std::string says;
  };
  const Slip slip =
      GENERATE(Slip{"golden mine.toml", 2, "--folder DIR"},
               Slip{"golden --folder kept --update", 2, "scenes"},
               Slip{"golden --folder kept mine.toml", 5, "--update"},
               Slip{"golden --folder kept --update mine.toml sub/mine.toml", 2, "mine"},
               Slip{"golden --folder kept --update mine.toml bad.toml", 3, "bad.toml:1:1"});
  CAPTURE(slip.arguments);
  const Folder scratch;
  std::filesystem::create_directories(scratch.path / "sub");
  for (const char* name : {"mine.toml", "sub/mine.toml"}) scratch.file(name, kWedgeAndBall);
  for (const char* name : {"wedge.obj", "sub/wedge.obj"}) scratch.file(name, kWedge);
  scratch.file("bad.toml", "titel = \"x\"\n" + kWedgeAndBall);
  const Outcome outcome = tumbleRun(scratch, slip.arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.code == slip.code);
  CHECK(outcome.lines() == 1);
  CHECK(outcome.says(slip.says));
  CHECK_FALSE(std::filesystem::exists(scratch.path / "kept"));
}
