// --set: the same key as in the file, another value.
#include "app/command/command.h"
#include "app/scene/scene.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

const std::string kText = R"(
[world]
gravity = [0, -9.81, 0]
[materials.rubber]
density = 1000
restitution = 0.5
[materials."hard.rubber"]
density = 1200
[pairs]
rubber-rubber = { friction = 0.5 }
[[body]]
name = "brick"
shape = { box = [1, 2, 3] }
material = "rubber"
[[body]]
name = "brick.2"
shape = { sphere = 0.5 }
mass = 1
[[array]]
name = "row"
kind = "row"
count = 2
step = [1, 0, 0]
body = { shape = { sphere = 0.25 }, mass = 1 }
vary = { friction = [0, 1] }
[[force]]
name = "breeze"
kind = "wind"
force = [1, 0, 0]
)";

Scene with(const std::vector<std::string>& overrides) {
  return parseScene(kText, "s.toml", overrides);
}

std::string overrideComplaint(const std::vector<std::string>& overrides) {
  try {
    with(overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("an override reaches every kind of key") {
  CHECK(with({"world.gravity=[0, -1.62, 0]"}).world.gravity == Vec3(0.0, -1.62, 0.0));
  CHECK(with({"world.gravity.1=-3"}).world.gravity == Vec3(0.0, -3.0, 0.0));
  CHECK(with({"world.method=stepping"}).world.method == "stepping");
  CHECK(with({"title=\"A = B\""}).title == "A = B");
  CHECK(with({"title=two words"}).title == "two words");
  CHECK(with({"course.step=0.125"}).world.course.step == 0.125);
  CHECK(with({"show.path=true"}).show.path);
  CHECK(with({"materials.rubber.restitution=0.25"}).world.bodies[0].restitution == 0.25);
  CHECK(with({"materials.hard.rubber.friction=1", "body.brick.material=hard.rubber"})
            .world.bodies[0]
            .friction == 1.0);
  CHECK(with({"pairs.rubber-rubber.friction=0.125"}).world.pairs[0].friction == 0.125);
  CHECK(with({"body.brick.mass=2"}).world.bodies[0].mass == 2.0);
  CHECK(with({"body.0.mass=2"}).world.bodies[0].mass == 2.0);
  CHECK(with({"body.brick.2.mass=3"}).world.bodies[1].mass == 3.0);
  CHECK(with({"body.brick.shape.box.0=4"}).world.bodies[0].mass == std::nullopt);
  CHECK(std::get<Box>(with({"body.brick.shape.box=[4,4,4]"}).world.bodies[0].shape).half.x() ==
        2.0);
  CHECK(with({"array.row.count=5"}).world.bodies.size() == 7);
  CHECK(with({"array.row.vary.friction=[0.25, 0.5]"}).world.bodies[2].friction == 0.25);
  const Scene large = with({"array.row.body.shape.sphere=0.375"});
  CHECK(std::get<Sphere>(large.world.bodies[3].shape).r == 0.375);
  CHECK(std::get<UniformWind>(with({"force.breeze.force=[0,0,2]"}).world.forces[0]).force.z() ==
        2.0);
}

TEST_CASE("the last of two overrides of one key wins, and both are written down") {
  const Scene scene = with({"body.brick.mass=2", "body.brick.mass=3"});
  CHECK(scene.world.bodies[0].mass == 3.0);
  CHECK(scene.line == "s body.brick.mass=2 body.brick.mass=3");
}

TEST_CASE("a refused override is named as such, beside what the file has wrong itself") {
  const auto begins = [](const std::string& text, const std::string& head) {
    INFO(text);
    return text.substr(0, head.size()) == head;
  };
  CHECK(begins(overrideComplaint({"body.brick.mass=-1"}),
               "--set body.brick.mass=-1: error: body.brick.mass: expected a number [kg] > 0"));
  CHECK(begins(overrideComplaint({"body.brick.mas=1"}),
               "--set body.brick.mas=1: error: body.brick.mas: unknown key, did you mean 'mass'?"));
  CHECK(begins(overrideComplaint({"body.brik.mass=1"}),
               "--set body.brik.mass=1: error: body.brik.mass: "
               "there is no 'brik', did you mean 'brick'?"));
  CHECK(begins(overrideComplaint({"body.7.mass=1"}),
               "--set body.7.mass=1: error: body.7.mass: "
               "there is no '7'"));
  CHECK(begins(overrideComplaint({"materials.ruber.friction=1"}),
               "--set materials.ruber.friction=1: error: materials.ruber.friction: "
               "there is no material 'ruber', did you mean 'rubber'?"));
  CHECK(begins(overrideComplaint({"world.gravity=[0, -1"}),
               "--set world.gravity=[0, -1: error: world.gravity: expected a list of 3 numbers"));
  CHECK(begins(overrideComplaint({"world.gravity.x=1"}), "--set world.gravity.x=1: error: "));
  CHECK(begins(overrideComplaint({"world.duration=2", "world.duration.x=1"}),
               "--set world.duration.x=1: error: world.duration.x: leads below 2"));
  CHECK(begins(overrideComplaint({"world.method=magic"}),
               "--set world.method=magic: error: world.method: unknown value 'magic'"));
  CHECK(
      begins(overrideComplaint({"title=\"a\"\nx = 1", "nonsense=1"}), "--set nonsense=1: error: "));
  CHECK(begins(overrideComplaint({"pairs.rubber-wood.friction=1"}),
               "--set pairs.rubber-wood.friction=1: "
               "error: "));
  const std::string both = overrideComplaint({"body.brik.mass=1", "camera.fov=0"});
  CHECK(both.find("--set body.brik.mass=1: error: ") != std::string::npos);
  CHECK(both.find("--set camera.fov=0: error: ") != std::string::npos);
}

TEST_CASE("a value cannot smuggle in further keys") {
  CHECK(with({"title=1\nclaim = \"x\""}).claim.empty());
  CHECK(with({"title=1\nclaim = \"x\""}).title == "1\nclaim = \"x\"");
}

TEST_CASE("an override without key or value is a wrong command line, not a wrong scene") {
  for (const std::string text : {"world.duration", "=1", "", ".a=1", "a.=1", "a..b=1"})
    CHECK_THROWS_AS(with({text}), UsageError);
}

TEST_CASE("a sweep's parameter is tried before anything runs") {
  const std::string sweep = "[sweep]\nparameter = \"materials.rubber.restitution\"\n";
  const Scene scene = parseScene(kText + sweep + "values = [0.0, 0.1, 1]\n", "s.toml");
  REQUIRE(scene.sweep);
  CHECK(scene.sweep->parameter == "materials.rubber.restitution");
  CHECK(scene.sweep->values == std::vector<std::string>{"0", "0.1", "1"});

  CHECK(overrideComplaint({"sweep.parameter=world.gravty", "sweep.values=[1]"})
            .find("--set sweep.parameter=world.gravty: error: world.gravty: unknown key") == 0);
}

TEST_CASE("every value of a sweep is an override that says the same as the file would") {
  const Scene scene = parseScene(kText + R"(
[sweep]
parameter = "title"
values = [ "plain", "true", "with \"quotes\"", "1", "tab\tbell\u0007", "é" ]
)",
                                 "s.toml");
  const std::vector<std::string> titles = {"plain", "true",        "with \"quotes\"",
                                           "1",     "tab\tbell\a", "é"};
  REQUIRE(scene.sweep->values.size() == titles.size());
  for (std::size_t i = 0; i < titles.size(); ++i)
    CHECK(with({"title=" + scene.sweep->values[i]}).title == titles[i]);
}
