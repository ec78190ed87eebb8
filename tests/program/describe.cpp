// What `tumble describe` says of a scene.
#include "tests/catch.h"
#include "tests/program/program.h"

namespace {

const std::string kTwoBodies = R"(title = "Two bodies"
checks = ["free-spin"]
[world]
method = "course"
gravity = [0, 0, 0]
duration = 2.0
[course]
integrator = "rkmk4"
step = 0.01
[[body]]
name = "brick"
shape = { box = [1, 2, 3] }
mass = 12.0
angular_velocity = [1, 0, 0]
[[body]]
name = "ell"
shape = { compound = [ { box = [1, 1, 1], position = [0, 0, 0] },
                       { box = [1, 1, 1], position = [1, 0, 0] },
                       { box = [1, 1, 1], position = [0, 1, 0] } ] }
density = 1000.0
position = [10, 0, 0]
)";

}  // namespace

// Oracle: closed form. A box has m (b² + c²)/12 about a; the L of three unit cubes has 7/6 and 11/6
// of ρ about its axes, products of 1/3 ρ, and 5/6, 3/2, 11/6 ρ about its principal axes.
TEST_CASE("describe says how time runs, and what each body weighs") {
  const Folder scratch;
  scratch.file("two.toml", kTwoBodies);
  const Outcome outcome = tumbleRun(scratch, "describe two.toml");
  CHECK(outcome.code == 0);
  CHECK(outcome.lines() == 0);
  for (const char* line :
       {"two: Two bodies\n", "checks    free-spin\n", "method    course, rkmk4 at 0.01 s, 2 s\n",
        "  brick: 12 kg, by surface\n",
        "    Ixx Iyy Izz             13           10            5\n",
        "  ell: 3000 kg, by surface\n",
        "    Ixx Iyy Izz        1166.67      1166.67      1833.33\n",
        "    Ixy Ixz Iyz        333.333            0            0\n",
        "    principal          833.333         1500      1833.33\n"}) {
    CAPTURE(outcome.out, line);
    CHECK(outcome.out.find(line) != std::string::npos);
  }
  const Outcome left = tumbleRun(scratch, "describe two.toml --set world.method=auto");
  CHECK(left.out.find("method    auto: exact, 2 s\n") != std::string::npos);
}

TEST_CASE("describe and simulate name settings of methods that auto does not take") {
  const Folder scratch;
  scratch.file("ball.toml",
               "[world]\nduration = 0.1\n[stepping]\nstep = 0.05\n[course]\n"
               "integrator = \"euler\"\n[[body]]\nname = \"ball\"\nmass = 1.0\n"
               "shape = { sphere = 0.1 }\n");
  for (const std::string command : {"describe", "simulate"}) {
    const Outcome outcome = tumbleRun(scratch, command + " ball.toml");
    CHECK(outcome.code == 0);
    CHECK(outcome.lines() == 1);
    CHECK(
        outcome.says("note: no part in this run, which `auto` gives to exact: "
                     "course.integrator, stepping.step; set world.method"));
    const Outcome named = tumbleRun(scratch, command + " ball.toml --set world.method=course");
    CHECK(named.lines() == 0);
  }
}

TEST_CASE("a check without claims says that nothing was checked, and how to claim something") {
  const Folder scratch;
  scratch.file("two.toml", kTwoBodies);
  const Outcome outcome = tumbleRun(scratch, "check two.toml --set checks=[]");
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("nothing was checked: no scene names a claim in `checks` or makes one by "
                         "[[expect]]") != std::string::npos);
}

TEST_CASE("what simulate writes of joints is told, and where they hold") {
  const Folder scratch;
  scratch.file("swing.toml",
               "[world]\nduration = 0.1\n[[body]]\nname = \"bob\"\nmass = 1.0\n"
               "shape = { sphere = 0.1 }\nposition = [1, 0, 0]\n[[joint]]\n"
               "kind = \"ball\"\na = \"bob\"\nanchor = [0, 2, 0]\n");
  const Outcome outcome = tumbleRun(scratch, "simulate swing.toml -o out");
  CAPTURE(outcome.err);
  CHECK(outcome.out.find("scene.json, joints.csv\n") != std::string::npos);
  CHECK(textOf(scratch / "out/scene.json").find("\"anchor_b\"") != std::string::npos);
}
