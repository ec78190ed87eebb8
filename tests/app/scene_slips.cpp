// One slip, one complaint, where it was made: no second one that only follows from the first.
#include "app/claim/verdict.h"
#include "app/record/recording.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

// A right scene of nine lines but for what is put in for line 9.
const std::string kStart =
    "[world]\n"
    "[materials.rubber]\n"
    "density = 1000\n"
    "[materials.air]\n"
    "friction = 0.1\n"
    "[[body]]\n"
    "name = \"ball\"\n"
    "shape = { sphere = 0.1 }\n";

// What the scene is told at the first thing that refuses it; "" if nothing does.
std::string told(const std::string& text) {
  try {
    const Scene scene = parseScene(text, "s.toml");
    requireKnownChecks(scene);
    makeWorld(scene);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("an everyday name of a shape or a key is answered by the one that is valid") {
  const auto [said, name] = GENERATE(table<const char*, const char*>({{"ball", "sphere"},
                                                                      {"cube", "box"},
                                                                      {"pill", "capsule"},
                                                                      {"tube", "cylinder"},
                                                                      {"egg", "ellipsoid"},
                                                                      {"ground", "plane"},
                                                                      {"half_space", "plane"}}));
  const std::string line =
      told(std::string("[world]\n[[body]]\nmass = 1\nshape = { ") + said + " = 0.1 }\n");
  CHECK(line.starts_with("s.toml:4:11: error: body.0.shape." + std::string(said) +
                         ": unknown key, did you mean '" + name + "'? Valid: "));
  CHECK(told(kStart + "weight = 1\n").find("did you mean 'mass'?") != std::string::npos);
  // Where nothing is called so, nothing is said of it.
  CHECK(told(kStart + "mass = 1\nball = 1\n").find("did you mean") == std::string::npos);
}

TEST_CASE("whoever misspells what a body weighs is not told that it weighs nothing") {
  struct Slip {
    std::string text, says;
  };
  const Slip table[] = {
      {"densty = 1000\n", "s.toml:9:1: error: body.ball.densty: unknown key, did you mean"},
      {"masss = 1\n", "s.toml:9:1: error: body.ball.masss: unknown key, did you mean 'mass'?"},
      {"density = \"heavy\"\n", "s.toml:9:11: error: body.ball.density: expected a number"},
      {"material = \"ruber\"\n", "s.toml:9:12: error: body.ball.material: unknown material"},
      {"material = \"oak\"\n[materials.oak]\ndensty = 700\n",
       "s.toml:11:1: error: materials.oak.densty: unknown key, did you mean 'density'?"},
      {"material = \"oak\"\nkick = { impulse = [1, 0, 0] }\n[materials.oak]\ndensity = \"x\"\n",
       "s.toml:12:11: error: materials.oak.density: expected a number"},
      {"[[array]]\nname = \"row\"\nkind = \"row\"\ncount = 2\nstep = [1, 0, 0]\n"
       "body = { shape = \"particle\", mas = 1 }\n",
       "s.toml:15:30: error: array.row.body.mas: unknown key, did you mean 'mass'?"},
  };
  for (const Slip& slip : table) {
    const bool array = slip.text.starts_with("[[");
    const std::string line = told(kStart + (array ? "mass = 1\n" : "") + slip.text);
    INFO(line);
    CHECK(line.find('\n') == std::string::npos);
    CHECK(line.starts_with(slip.says));
  }
  // Without a slip it is missing indeed.
  CHECK(told(kStart).starts_with("s.toml:6:1: error: body.ball.mass: missing"));
  CHECK(told(kStart + "material = \"air\"\n").starts_with("s.toml:6:1: error: body.ball.mass"));
  CHECK(told(kStart + "material = \"rubber\"\n").empty());
  const std::string none = told("[world]\n[[body]]\nshape = { sphere = 1 }\nmaterial = \"oak\"\n");
  CHECK(none ==
        "s.toml:4:12: error: body.0.material: unknown material 'oak'; there is no "
        "[materials.oak]");
}

TEST_CASE(
    "a check that is none is refused where it stands, with the nearest one and all there are") {
  const std::string ball = kStart + "mass = 1\n";
  const std::string line = told("checks = [\"books\", \"setled\"]\n" + ball);
  INFO(line);
  CHECK(
      line.starts_with("s.toml:1:20: error: checks: unknown check 'setled', did you mean "
                       "'settled'? Valid: "));
  for (const Check& check : checks()) {
    CAPTURE(check.name);
    CHECK(line.find(std::string(check.name)) != std::string::npos);
  }
  CHECK(told("checks = [\"books\"]\n" + ball).empty());
}

TEST_CASE("what is wrong with a joint names it, or the bodies that it joins") {
  struct Slip {
    std::string text, says;
  };
  const std::string hinge = "[[joint]]\nname = \"arm\"\nkind = \"hinge\"\na = \"ball\"\n";
  const Slip table[] = {
      {hinge + "anchor = [0, 1, 0]\n", "s.toml:10:1: error: joint.arm.axis: missing"},
      {hinge + "anchor = [0, 1, 0]\naxis = [0, 0, 1]\nmin = 10\nmax = 5\n",
       "s.toml:16:7: error: joint \"arm\" of \"ball\" and the world: the lower limit lies above"},
      {hinge + "anchor = [0, 1, 0]\naxis = [0, 0, 1]\nmin = 5\n",
       "s.toml:16:7: error: joint \"arm\" of \"ball\" and the world begins beyond its lower limit"},
      {"[[joint]]\nkind = \"ball\"\na = \"ball\"\nanchor = [0, 1, 0]\n[[joint]]\nkind = "
       "\"distance\"\n"
       "a = \"ball\"\nanchor = [0, 1, 0]\nanchor_b = [0, 1, 0]\n",
       "s.toml:17:10: error: joint \"joint.1\" of \"ball\" and the world: a rod needs two anchors"},
  };
  for (const Slip& slip : table) {
    const std::string line = told(kStart + "mass = 1\n" + slip.text);
    INFO(line);
    CHECK(line.starts_with(slip.says));
    CHECK(line.find('\n') == std::string::npos);
  }
}

TEST_CASE("a method's own key in [world] is told which tables take it") {
  const std::string body = "[[body]]\nshape = { sphere = 1 }\nmass = 1\n";
  CHECK(told("[world]\nstep = 0.01\n" + body) ==
        "s.toml:2:1: error: world.step: unknown key here; set course.step for method 'course', or "
        "stepping.step for method 'stepping'");
  CHECK(told("[world]\nsolver = \"pgs\"\n" + body) ==
        "s.toml:2:1: error: world.solver: unknown key here; set stepping.solver for method "
        "'stepping'");
  CHECK(
      told("[world]\nstp = 0.01\n" + body) ==
      "s.toml:2:1: error: world.stp: unknown key; valid: gravity, method, impact, duration, seed");
}
