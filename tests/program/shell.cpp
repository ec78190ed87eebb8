// The program among other programs: completions, the manual, quiet, parts of a sequence, Ctrl-C.
#include <set>

#include "tests/catch.h"
#include "tests/program/program.h"

namespace {

const std::string kDrawnBall = R"([world]
duration = 0.2
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 1.0
position = [0, 2, 0]
[image]
size = [160, 96]
)";

std::set<std::string> namesIn(const std::string& text, const std::string& begin) {
  std::set<std::string> names;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(begin);
    if (at == std::string::npos ||
        line.substr(0, at).find_first_not_of(" -,qoh") != std::string::npos)
      continue;
    names.insert(line.substr(at, line.find_first_of(" ,", at) - at));
  }
  return names;
}

std::vector<std::string> commands(const Folder& scratch) {
  std::vector<std::string> names;
  std::istringstream lines(tumbleRun(scratch, "--help").out);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  ") && line.size() > 2)
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

// A process that waits, then ends this shell, or what it has become, without a warning.
std::string killedAfter(const std::string& wait) {
  return "self=$(exec sh -c 'echo $PPID'); (" + wait + "; kill -9 $self) & :";
}

std::string untilThereIs(const std::string& file) {
  return "n=0; until [ -e " + file + " ] || [ $((n += 1)) -gt 6000 ]; do sleep 0.005; done";
}

}  // namespace

TEST_CASE("completions and the manual know every command and every option of its help") {
  const Folder scratch;
  const std::string manual = tumbleRun(scratch, "man").out;
  const std::string bash = tumbleRun(scratch, "completion bash").out;
  const std::string zsh = tumbleRun(scratch, "completion zsh").out;
  const std::string fish = tumbleRun(scratch, "completion fish").out;
  int options = 0;
  for (const std::string& command : commands(scratch)) {
    CAPTURE(command);
    CHECK(holds(manual, ".SS tumble " + command));
    CHECK(holds(bash, "    " + command + ") words="));
    CHECK(holds(zsh, "    " + command + ") _arguments"));
    for (const std::string& option : namesIn(tumbleRun(scratch, command + " --help").out, "--")) {
      if (option == "--help") continue;
      CAPTURE(option);
      ++options;
      std::string dashes = option;
      for (std::size_t at = 0; (at = dashes.find('-', at)) != std::string::npos; at += 2)
        dashes.insert(at, "\\");
      CHECK(holds(manual, dashes));
      CHECK(holds(bash, option));
      CHECK(holds(zsh, "'*" + option + "["));
      CHECK(holds(fish, "_from " + command + "' -l " + option.substr(2) + " "));
    }
  }
  CHECK(options > 40);
  CHECK(tumbleRun(scratch, "completion zhs").says("'zsh'"));
}

TEST_CASE("bash completes commands, options of the command, demos and shells") {
  const Folder scratch;
  const std::string ask =
      "export PATH=\"$(dirname '" + std::string(TUMBLE_PROGRAM) +
      "'):$PATH\"; bash -c 'source <(tumble completion bash); ask() { COMP_WORDS=(\"$@\"); "
      "COMP_CWORD=$(($# - 1)); _tumble; echo \"${COMPREPLY[@]}\" >>said; }; ask tumble rend; "
      "ask tumble golden --fol; ask tumble check path-of; ask tumble completion z'";
  CHECK(tumbleRun(scratch, "--version", ask).code == 0);
  CHECK(textOf(scratch.path / "said") == "render\n--folder\npath-of-brick\nzsh\n");
}

TEST_CASE("a misspelt option is answered with the nearest one, a file with the nearest file") {
  const Folder scratch;
  scratch.file("billiard.toml", kDrawnBall);
  const Outcome option = tumbleRun(scratch, "render billiard.toml --stil 1");
  CHECK(option.code == 2);
  CHECK(option.says("did you mean '--still'"));
  CHECK(option.lines() == 1);
  const Outcome scene = tumbleRun(scratch, "render bilard.toml");
  CHECK(scene.code == 5);
  CHECK(scene.says("did you mean 'billiard.toml'"));
  CHECK(tumbleRun(scratch, "render bilard").says("did you mean 'billiard.toml'"));
}

TEST_CASE("two shards, three jobs and one run draw the same bytes, and quiet says nothing") {
  const Folder scratch;
  scratch.file("ball.toml", kDrawnBall);
  CHECK(tumbleRun(scratch, "render ball.toml -o one").code == 0);
  for (const std::string arguments :
       {"-o two --shard 1/2", "-o two --shard 0/2", "-o jobs --jobs 3"}) {
    const Outcome outcome = tumbleRun(scratch, "render ball.toml -q " + arguments);
    CAPTURE(arguments, outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
  }
  REQUIRE(filesBelow(scratch.path / "one") == 13);
  for (const char* folder : {"two", "jobs"}) {
    CHECK(filesBelow(scratch.path / folder) == 13);
    for (const auto& image : std::filesystem::directory_iterator(scratch.path / "one"))
      CHECK(textOf(image.path()) == textOf(scratch.path / folder / image.path().filename()));
  }
}

TEST_CASE(
    "what is killed, again and again, leaves whole images alone and goes on to the same bytes") {
  const Folder scratch;
  scratch.file("ball.toml", kDrawnBall);
  const std::string render = "render ball.toml -q --set image.rate=1000 -o ";
  CHECK(tumbleRun(scratch, render + "whole").code == 0);
  const long all = filesBelow(scratch.path / "whole");
  const auto allAreWhole = [&] {
    for (const auto& image : std::filesystem::directory_iterator(scratch.path / "killed"))
      if (textOf(image.path()) != textOf(scratch.path / "whole" / image.path().filename()))
        return false;
    return true;
  };
  long before = 0;
  for (const char* image : {"killed/image-000020.png", "killed/image-000110.png"}) {
    CHECK(tumbleRun(scratch, render + "killed", killedAfter(untilThereIs(image))).code == 128 + 9);
    const long done = filesBelow(scratch.path / "killed");
    CHECK((before < done && done < all));
    CHECK(allAreWhole());
    before = done;
  }
  CHECK(tumbleRun(scratch, render + "killed").code == 0);
  CHECK(filesBelow(scratch.path / "killed") == all);
  CHECK(allAreWhole());
}

TEST_CASE("numbers of a run that is killed leave no file behind, new or in place of old ones") {
  const Folder scratch;
  scratch.file("ball.toml", kDrawnBall);
  const std::string simulate = "simulate ball.toml -q -o out";
  const std::string asLong = " --set world.duration=999 --set image.rate=1000";
  CHECK(tumbleRun(scratch, simulate + asLong, killedAfter("sleep 0.3")).code == 128 + 9);
  CHECK(filesBelow(scratch.path / "out") == 0);
  CHECK(tumbleRun(scratch, simulate).code == 0);
  const long all = filesBelow(scratch.path / "out");
  const std::string whole = textOf(scratch.path / "out/trajectory.csv");
  CHECK(tumbleRun(scratch, simulate + asLong, killedAfter("sleep 0.3")).code == 128 + 9);
  CHECK(filesBelow(scratch.path / "out") == all);
  CHECK(textOf(scratch.path / "out/trajectory.csv") == whole);
}

TEST_CASE("the first Ctrl-C is answered at once, the second ends a run far from its next sample") {
  const Folder scratch;
  scratch.file("ball.toml", kDrawnBall);
  // The folder is made in the midst of the first sample; 0.2 s of work later that is long done.
  const std::string twice =
      "self=$(exec sh -c 'echo $PPID'); work() { cut -d' ' -f14 /proc/$self/stat; }; (" +
      untilThereIs("out") + "; w=$(work); n=0; until [ $(($(work) - w)) -ge 20 ] || " +
      "[ $((n += 1)) -gt 6000 ]; do sleep 0.005; done; kill -INT $self; n=0; " +
      "until grep -q again .err || [ $((n += 1)) -gt 6000 ]; do sleep 0.005; done; " +
      "kill -INT $self) & :";
  const Outcome outcome =
      tumbleRun(scratch,
                "simulate ball.toml -q -o out --set world.gravity=[0,0,0] --set world.duration=900 "
                "--set image.rate=0.01 --set world.method=course --set course.step=1e-6",
                twice);
  CHECK(outcome.code == 128 + 2);
  CHECK(outcome.says("Ctrl-C again ends it at once"));
  CHECK_FALSE(outcome.says("stopped while simulating"));  // as it says between two samples
}

TEST_CASE("images of another run are named, and so is a range that reaches beyond the end") {
  const Folder scratch;
  scratch.file("ball.toml", kDrawnBall);
  const Outcome first = tumbleRun(scratch, "render ball.toml -o out --frames 11:50");
  CHECK(first.code == 0);
  CHECK(first.says("--frames 11:50: the sequence ends with image 12"));
  const Outcome second =
      tumbleRun(scratch, "render ball.toml -o out --frames 0:1 --set world.gravity=[0,-1,0]");
  CHECK(second.says("2 of the images in out are not of this run, the first is image-000011.png"));
  CHECK_FALSE(tumbleRun(scratch, "render ball.toml -o out --frames 12:13").says("image-000012"));
}

TEST_CASE("Ctrl-C ends between two images, says how many are there, and the next run goes on") {
  const Folder scratch;
  scratch.file("long.toml", "camera = { elevation = 20 }\n" + kDrawnBall + "rate = 500\n");
  const Outcome outcome =
      tumbleRun(scratch, "render long.toml -o out",
                "me=$(exec sh -c 'echo $PPID'); "
                "(while [ ! -e out/image-000002.png ]; do sleep .02; done; kill -INT $me) & :");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 130);
  CHECK(outcome.says(" of 101 images are there; run again to go on"));
  const long drawn = filesBelow(scratch.path / "out");
  CHECK(drawn >= 3);
  CHECK(drawn < 101);
}

TEST_CASE("processes that draw for one that is asked to stop, stop with it") {
  const Folder scratch;
  scratch.file("long.toml", "camera = { elevation = 20 }\n" + kDrawnBall + "rate = 500\n");
  const Outcome outcome =
      tumbleRun(scratch, "render long.toml -o out --jobs 2",
                "me=$(exec sh -c 'echo $PPID'); "
                "(while [ ! -e out/image-000002.png ]; do sleep .02; done; kill -TERM $me) & :");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 130);
  CHECK(outcome.says(" of 101 images are there; run again to go on"));
  CHECK(filesBelow(scratch.path / "out") < 101);
}

TEST_CASE("a film that is stopped by Ctrl-C leaves nothing of it") {
  const Folder scratch;
  scratch.file("long.toml", "camera = { elevation = 20 }\n" + kDrawnBall + "rate = 500\n");
  const Outcome outcome = tumbleRun(
      scratch, "render long.toml -o out --video film.mp4 --set world.duration=2",
      "me=$(exec sh -c 'echo $PPID'); " +
          std::string("(while [ ! -e .film.part.mp4 ]; do sleep .02; done; kill -INT $me) & :"));
  CAPTURE(outcome.err);
  CHECK(outcome.code == 130);
  CHECK(outcome.says("stopped while filming"));
  CHECK_FALSE(std::filesystem::exists(scratch / ".film.part.mp4"));
  CHECK_FALSE(std::filesystem::exists(scratch / "film.mp4"));
}

TEST_CASE("a sweep of which a later value is refused runs none") {
  const Folder scratch;
  scratch.file("ball.toml",
               kDrawnBall + "[sweep]\nparameter = \"body.ball.mass\"\nvalues = [1, 2, -3]\n");
  const Outcome outcome = tumbleRun(scratch, "sweep ball.toml -o out");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 3);
  CHECK(outcome.says("body.ball.mass: expected a number [kg] > 0, found -3"));
  CHECK_FALSE(std::filesystem::exists(scratch / "out"));
}

TEST_CASE("a sweep whose claims fail says so, and check tells of a scene in which nothing moved") {
  const Folder scratch;
  scratch.file("rest.toml",
               "checks = [\"settled\"]\n" + kDrawnBall +
                   "[sweep]\nparameter = \"body.ball.position\"\nvalues = [[0, 0.5, 0]]\n");
  const Outcome sweep = tumbleRun(scratch, "sweep rest.toml -o out");
  CHECK(sweep.code == 1);
  CHECK(sweep.says("claims fail for 1 of 1 values of body.ball.position"));
  const Outcome check = tumbleRun(scratch, "check rest.toml --set body.ball.position=[0,0.1,0]");
  CAPTURE(check.out, check.err);
  CHECK(holds(check.out, "nothing moved"));
}

TEST_CASE("a gallery of two scenes of one name is refused before any is drawn") {
  const Folder scratch;
  std::filesystem::create_directories(scratch / "other");
  for (const char* name : {"ball.toml", "other/ball.toml"}) scratch.file(name, kDrawnBall);
  const Outcome outcome = tumbleRun(scratch, "gallery ball.toml other/ball.toml -o out");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.says("'ball.toml' and 'other/ball.toml' would both be drawn into 'ball'"));
  CHECK_FALSE(std::filesystem::exists(scratch / "out"));
}

TEST_CASE("panels that a scene has not got keep no other picture from being drawn") {
  const Folder scratch;
  scratch.file("ball.toml", kDrawnBall);
  CHECK(tumbleRun(scratch, "render ball.toml --panels -o out").code == 2);
  const Outcome outcome = tumbleRun(scratch, "render ball.toml --strobe --panels -o out");
  CHECK(outcome.code == 0);
  CHECK(outcome.says("note: no --panels: ball.toml has neither [[panel]]"));
  CHECK(std::filesystem::exists(scratch / "out/strobe.png"));
}

TEST_CASE("a sweep over fewer values leaves nothing of one over more") {
  const Folder scratch;
  scratch.file("ball.toml",
               kDrawnBall + "[sweep]\nparameter = \"body.ball.mass\"\nvalues = [1, 2, 3]\n");
  CHECK(tumbleRun(scratch, "sweep ball.toml -o out").code == 0);
  CHECK(filesBelow(scratch / "out") == 5);
  CHECK(tumbleRun(scratch, "sweep ball.toml -o out --set sweep.values=[4]").code == 0);
  CHECK(filesBelow(scratch / "out") == 3);
  CHECK_FALSE(std::filesystem::exists(scratch / "out/sweep-1"));
}
