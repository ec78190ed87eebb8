// What `tumble check --state` says of a scene's start, and the picture that it draws.
#include "tests/catch.h"
#include "tests/program/program.h"

namespace {

const std::string kFallingBrick = R"([world]
duration = 1.0
[materials.wood]
density = 500.0
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[body]]
name = "brick"
shape = { box = [0.4, 0.2, 0.3] }
material = "wood"
position = [0, 0.1, 0]
[image]
size = [160, 90]
)";

}  // namespace

TEST_CASE("check --state names the layer of a start that is not legal, and draws it") {
  const Folder scratch;
  scratch.file("s.toml", kFallingBrick);
  Outcome outcome = tumbleRun(scratch, "check --state s.toml");
  CHECK(outcome.code == 0);
  CHECK(outcome.lines() == 0);
  CHECK(outcome.out ==
        "s: the state at its start\n"
        "  positions     ok\n"
        "  velocities    ok\n"
        "  accelerations ok      forces at 4 contact points hold what would close at up to 9.81 "
        "m/s²\n");
  CHECK(filesBelow(scratch.path) == 1);

  outcome = tumbleRun(scratch, "check --state s.toml --set body.brick.position=[0,0.08,0] -o out");
  CHECK(outcome.code == 1);
  CHECK(outcome.out.find("  positions     NOT OK\n    \"brick\" is 0.02 m inside \"floor\"\n"
                         "  velocities    ok\n  accelerations ok") != std::string::npos);
  CHECK(std::filesystem::exists(scratch / "out/state.png"));

  outcome =
      tumbleRun(scratch, "check --state s.toml --json --set body.brick.position=[0,0.08,0] -o out");
  CHECK(outcome.code == 1);
  CHECK(outcome.out.starts_with("[\n  {\n    \"scene\": \"s\",\n    \"holds\": false,"));
  CHECK(outcome.out.find("\"layer\": \"positions\"") != std::string::npos);
  CHECK(outcome.out.find("0.02 m inside") != std::string::npos);
  CHECK(outcome.out.find("state.png") == std::string::npos);

  outcome = tumbleRun(scratch, "check --state s.toml --set body.brick.velocity=[0,-0.5,0]");
  CHECK(outcome.code == 1);
  CHECK(outcome.out.find("  positions     ok\n  velocities    NOT OK\n    \"brick\" moves into "
                         "\"floor\" at 0.5 m/s\n  accelerations ok") != std::string::npos);

  outcome = tumbleRun(
      scratch, "check --state s.toml --set world.method=course --set course.contact=penalty");
  CHECK(outcome.code == 1);
  CHECK(outcome.out.find("  accelerations NOT OK\n    \"brick\" accelerates into \"floor\" at 9.81 "
                         "m/s²\n") != std::string::npos);

  // The run itself refuses what overlaps, and so does a check of its claims.
  CHECK(tumbleRun(scratch, "simulate s.toml --set body.brick.position=[0,0.08,0]").code == 3);
  CHECK(tumbleRun(scratch, "check s.toml -o out").code == 2);
  CHECK(tumbleRun(scratch, "check --state s.toml --set body.brick.mass=-1").code == 3);
}
