// Bad input: each mistake gets one clear line with place and remedy, the designed exit code, and
// leaves nothing half-written.
#include "tests/catch.h"
#include "tests/program/program.h"

namespace {

enum Exit { kUsage = 2, kScene = 3, kNoContext = 4, kFile = 5 };

const std::string kBall = R"([world]
duration = 0.5
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 1.0
position = [0, 2, 0]
)";

// kBall with one piece of text replaced.
std::string spoilt(const std::string& what, const std::string& by) {
  std::string text = kBall;
  return text.replace(text.find(what), what.size(), by);
}

struct Mistake {
  const char* name;
  std::string scene;
  std::vector<std::string> says;  ///< what the line has to hold
};

}  // namespace

TEST_CASE("the scene that the mistakes are made in is itself accepted") {
  const Folder scratch;
  scratch.file("scene.toml", kBall);
  const Outcome outcome = tumbleRun(scratch, "simulate scene.toml -o out");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(filesBelow(scratch / "out") == 5);
}

TEST_CASE("a scene that cannot be is refused with its place, what is wrong and what is expected") {
  const Mistake mistake = GENERATE(
      Mistake{"unknown key",
              spoilt("duration", "durration"),
              {"scene.toml:2:1", "durration", "duration"}},
      Mistake{"unknown key of a body",
              kBall + "colur = [1, 0, 0]\n",
              {"scene.toml:11:1", "colur", "colour"}},
      Mistake{"wrong type", spoilt("0.5", "\"long\""), {"scene.toml:2:", "duration", "number"}},
      Mistake{"not a number",
              spoilt("[0, 2, 0]", "[0, nan, 0]"),
              {"scene.toml:10:", "position", "nan"}},
      Mistake{"no mass", spoilt("mass = 1.0", "mass = 0.0"), {"scene.toml:9:", "mass", "0"}},
      Mistake{
          "negative mass", spoilt("mass = 1.0", "mass = -3.0"), {"scene.toml:9:", "mass", "-3"}},
      Mistake{"neither mass nor density", spoilt("mass = 1.0\n", ""), {"ball", "mass", "density"}},
      Mistake{"restitution above one",
              kBall + "material = \"m\"\n[materials.m]\nrestitution = 1.5\n",
              {"scene.toml:13:", "restitution", "1.5"}},
      Mistake{"restitution below zero",
              kBall + "material = \"m\"\n[materials.m]\nrestitution = -0.1\n",
              {"scene.toml:13:", "restitution", "-0.1"}},
      Mistake{"unknown method",
              spoilt("duration = 0.5", "method = \"curse\""),
              {"scene.toml:2:", "curse", "course"}},
      Mistake{"no bodies", "[world]\nduration = 1.0\n", {"scene.toml", "body"}},
      Mistake{"no world",
              "[[body]]\nname = \"a\"\nmass = 1.0\nshape = { sphere = 1.0 }\n",
              {"scene.toml", "world"}},
      Mistake{"two of one name", spoilt("\"floor\"", "\"ball\""), {"scene.toml:7:", "ball"}},
      Mistake{"overlapping start", spoilt("[0, 2, 0]", "[0, 0.06, 0]"), {"ball", "floor", "0.04"}},
      Mistake{"not TOML", spoilt("duration = 0.5", "duration = = 0.5"), {"scene.toml:2:"}});
  CAPTURE(mistake.name);
  const Folder scratch;
  scratch.file("scene.toml", mistake.scene);
  const Outcome outcome = tumbleRun(scratch, "simulate scene.toml -o out");
  CAPTURE(outcome.err);
  CHECK(outcome.code == kScene);
  CHECK(outcome.lines() == 1);
  for (const std::string& text : mistake.says) {
    CAPTURE(text);
    CHECK(outcome.says(text));
  }
  CHECK_FALSE(std::filesystem::exists(scratch / "out"));
}

TEST_CASE("a scene that is refused is refused by check too, with claims and without") {
  const std::string checks = GENERATE("", "checks = [\"rest-time\"]\n");
  const std::string wrong = GENERATE(as<std::string>(), "[0, 0.06, 0]", "[0, nan, 0]");
  const Folder scratch;
  scratch.file("scene.toml", checks + spoilt("[0, 2, 0]", wrong));
  const Outcome outcome = tumbleRun(scratch, "check scene.toml");
  CAPTURE(checks, wrong, outcome.err);
  CHECK(outcome.code == kScene);
  CHECK(outcome.lines() == 1);
  CHECK(outcome.says(checks.empty() ? "scene.toml:10:" : "scene.toml:11:"));
  CHECK(outcome.out.empty());
}

TEST_CASE("a scene that its method refuses leaves no folder of images") {
  const Folder scratch;
  scratch.file("scene.toml", kBall + "[[force]]\nkind = \"drag\"\nlinear = 1.0\n");
  const Outcome outcome =
      tumbleRun(scratch, "render scene.toml --set world.method=exact --still 0 -o out");
  CAPTURE(outcome.err);
  CHECK(outcome.code == kScene);
  CHECK_FALSE(std::filesystem::exists(scratch / "out"));
}

// The same holds for what is interrupted before a scene is read to its end.
TEST_CASE("a scene that is refused leaves no folder, whatever was to be made of it") {
  const std::string command =
      GENERATE("gallery", "report", "sweep", "converge", "render --still 0");
  const Folder scratch;
  scratch.file("scene.toml", spoilt("mass = 1.0", "mass = -1.0"));
  const Outcome outcome = tumbleRun(scratch, command + " scene.toml -o out");
  CAPTURE(command, outcome.err);
  CHECK(outcome.code == kScene);
  CHECK_FALSE(std::filesystem::exists(scratch / "out"));
}

TEST_CASE("several mistakes of one file are told together, first first") {
  const Folder scratch;
  std::string text = spoilt("mass = 1.0", "mass = -1.0");
  text.replace(text.find("duration = 0.5"), 14, "duration = -1 ");
  scratch.file("scene.toml", text);
  const Outcome outcome = tumbleRun(scratch, "simulate scene.toml");
  CAPTURE(outcome.err);
  CHECK(outcome.code == kScene);
  CHECK(outcome.lines() == 2);
  CHECK(outcome.err.find("duration") < outcome.err.find("mass"));
}

TEST_CASE("a command line that makes no sense ends with 2 and one line") {
  struct Slip {
    std::string arguments;
    std::string says;
  };
  const Slip slip = GENERATE(
      Slip{"rendr scene.toml", "render"}, Slip{"simulate", "SCENE"},
      Slip{"simulate scene.toml --fps 9", "--fps"}, Slip{"render scene.toml --frames 9:3", "9:3"},
      Slip{"render scene.toml --frames a:b", "a:b"}, Slip{"render scene.toml --size 0x0", "0x0"},
      Slip{"simulate scene.toml --set world.duration", "KEY=VALUE"},
      Slip{"simulate scene.toml --set =3", "KEY=VALUE"},
      Slip{"simulate scene.toml --rate -5", "--rate"},
      Slip{"simulate scene.toml --rate nan", "--rate"},
      Slip{"render scene.toml --rate inf", "--rate"},
      Slip{"render scene.toml --still nan", "--still"},
      Slip{"render scene.toml --still --sheet", "--still: expected SECONDS, found '--sheet'"},
      Slip{"simulate scene.toml --threads 0", "a number from 1 to 256, found 0"},
      Slip{"simulate scene.toml --threads 2.5", "a whole number from 1 to 256, found '2.5'"},
      Slip{"report scene.toml --budget nan", "--budget"},
      Slip{"report scene.toml --budget inf", "--budget"},
      Slip{"golden no-such-demo", "no-such-demo"});
  CAPTURE(slip.arguments);
  const Folder scratch;
  scratch.file("scene.toml", kBall);
  const Outcome outcome = tumbleRun(scratch, slip.arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.code == kUsage);
  CHECK(outcome.lines() == 1);
  CHECK(outcome.says(slip.says));
  CHECK(filesBelow(scratch.path) == 1);
}

TEST_CASE("a scene that is neither a demo nor a file ends with 5, and a refused --set with 3") {
  struct Slip {
    std::string arguments;
    std::vector<std::string> says;
    int code;
  };
  const Slip slip =
      GENERATE(Slip{"simulate path-of-brik", {"path-of-brik", "path-of-brick"}, kFile},
               Slip{"simulate missing.toml", {"missing.toml"}, kFile},
               Slip{"simulate .", {"is a folder"}, kFile},
               Slip{"simulate scene.toml --set body.ball.mass=-1", {"--set", "mass"}, kScene},
               Slip{"simulate scene.toml --set world.gravty=1", {"--set", "gravity"}, kScene});
  CAPTURE(slip.arguments);
  const Folder scratch;
  scratch.file("scene.toml", kBall);
  const Outcome outcome = tumbleRun(scratch, slip.arguments + " -o out");
  CAPTURE(outcome.err);
  CHECK(outcome.code == slip.code);
  CHECK(outcome.lines() == 1);
  for (const std::string& text : slip.says) CHECK(outcome.says(text));
  CHECK_FALSE(std::filesystem::exists(scratch / "out"));
}

TEST_CASE("an output folder below a regular file ends with 5, for root too") {
  const std::string command = GENERATE("simulate", "render", "sweep");
  const Folder scratch;
  scratch.file("scene.toml",
               kBall + "[sweep]\nparameter = \"world.duration\"\nvalues = [0.1, 0.2]\n");
  scratch.file("file", "in the way");
  const Outcome outcome = tumbleRun(scratch, command + " scene.toml -o file/out");
  CAPTURE(command, outcome.err);
  CHECK(outcome.code == kFile);
  CHECK(outcome.lines() == 1);
  CHECK(outcome.says("file/out"));
  CHECK(textOf(scratch / "file") == "in the way");
}

TEST_CASE("a disk that fills up half-way ends with 5 and leaves no half-written file") {
  struct Run {
    std::string command, ending;
  };
  const Run run = GENERATE(Run{"simulate scene.toml --rate 20000 -o out", ".csv"},
                           Run{"render scene.toml --frames 0:2 -o out", ".png"});
  const Folder scratch;
  scratch.file("scene.toml", kBall);
  const Outcome outcome = tumbleRun(scratch, run.command, "ulimit -f 32");
  CAPTURE(run.command, outcome.err);
  CHECK(outcome.code == kFile);
  CHECK(outcome.lines() == 1);
  CHECK(outcome.says("out/"));
  CHECK(filesBelow(scratch / "out") == 0);
}

TEST_CASE("standard output that cannot be written ends with 5") {
  const Folder scratch;
  const Outcome outcome = tumbleRun(scratch, "list >/dev/full");
  CAPTURE(outcome.err);
  CHECK(outcome.code == kFile);
  CHECK(outcome.lines() == 1);
}

TEST_CASE("an error that cannot be told still ends with its own code") {
  const Folder scratch;
  scratch.file("scene.toml", spoilt("mass = 1.0", "mass = 0.0"));
  CHECK(tumbleRun(scratch, "render scene.toml 2>/dev/full").code == kScene);
}

TEST_CASE("without an OpenGL context nothing is drawn and the program ends with 4") {
  const Folder scratch;
  scratch.file("scene.toml", kBall);
  const Outcome outcome =
      tumbleRun(scratch, "render scene.toml -o out", "export TUMBLE_GL=nonsense");
  CAPTURE(outcome.err);
  CHECK(outcome.code == kNoContext);
  CHECK(outcome.lines() == 1);
  CHECK(outcome.says("nonsense"));
  CHECK(outcome.says("osmesa"));
  CHECK(filesBelow(scratch / "out") == 0);
}

TEST_CASE("without a display the window is refused with 4 and the way out") {
  const Folder scratch;
  scratch.file("scene.toml", kBall);
  const Outcome outcome = tumbleRun(scratch, "view scene.toml", "unset DISPLAY WAYLAND_DISPLAY");
  CAPTURE(outcome.err);
  CHECK(outcome.code == kNoContext);
  CHECK(outcome.lines() == 1);
  CHECK(outcome.says("tumble render"));
}

TEST_CASE("missing shaders end with 4 or 5 and name the folder, never with a black image") {
  const Folder scratch;
  scratch.file("scene.toml", kBall);
  const Outcome outcome = tumbleRun(scratch, "render ./scene.toml -o out",
                                    "mkdir -p data/demos data/fonts; export TUMBLE_DATA=data");
  CAPTURE(outcome.err);
  CHECK((outcome.code == kNoContext || outcome.code == kFile));
  CHECK(outcome.lines() == 1);
  CHECK(outcome.says("data/shaders"));
  CHECK(filesBelow(scratch / "out") == 0);
}
