// What a right scene file means.
#include "app/scene/scene.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

Scene read(const std::string& text) {
  return parseScene("[world]\n" + text, "folder/name.toml");
}

BodyDef body(const std::string& keys) {
  return read("[[body]]\n" + keys).world.bodies.at(0);
}

const std::string kBallKeys = "shape = { sphere = 0.5 }\nmass = 1\n";

}  // namespace

TEST_CASE("what a scene leaves out has the defaults of the contract") {
  const Scene scene = read("[[body]]\n" + kBallKeys);
  CHECK(scene.name == "name");
  CHECK(scene.line == "name");
  CHECK(scene.seed == 42);
  const WorldDef& world = scene.world;
  CHECK(world.gravity == Vec3(0.0, -9.81, 0.0));
  CHECK(world.method == "auto");
  CHECK(world.impact == "auto");
  CHECK(world.duration == 5.0);
  CHECK(world.course.step == 1.0 / 240.0);
  CHECK(world.course.integrator == "rk4");
  CHECK(world.stepping.step == 1.0 / 240.0);
  CHECK(scene.image.width == 1280);
  CHECK(scene.image.height == 720);
  CHECK(scene.image.rate == 60.0);
  CHECK_FALSE(scene.camera.eye);
  CHECK_FALSE(scene.sweep);
  const BodyDef& ball = world.bodies.at(0);
  CHECK(ball.name == "body.0");
  CHECK(ball.position == Vec3::Zero());
  CHECK(ball.velocity == Vec3::Zero());
  CHECK(ball.angularVelocity == Vec3::Zero());
  CHECK(ball.orientation.coeffs() == Quat::Identity().coeffs());
  CHECK(ball.restitution == 0.0);
  CHECK(ball.friction == 0.0);
  CHECK_FALSE(ball.fixed);
  CHECK_FALSE(scene.colours.at(0));
  CHECK(scene.labels.at(0).empty());
}

TEST_CASE("every key of the contract arrives where the world looks for it") {
  const Scene scene = parseScene(R"(
title = "T"
subtitle = "S"
chapter = "C"
claim = "X"
checks = ["a", "b"]
[world]
gravity = [1, 2, 3]
method = "stepping"
impact = "sequential"
duration = 7
seed = 9
[course]
integrator = "midpoint"
step = 0.5
plan = "backstep"
contact = "constraint"
[stepping]
step = 0.25
solver = "pivoting"
tolerance = 1e-3
[materials.a]
density = 2
restitution = 0.5
friction = 0.75
colour = [0.1, 0.2, 0.3]
[materials.b]
[pairs]
a-b = { restitution = 0.25 }
[[body]]
name = "one"
shape = { box = [2, 4, 6] }
material = "a"
position = [1, 2, 3]
velocity = [4, 5, 6]
angular_velocity = [7, 8, 9]
inertia = [1, 2, 3]
label = "L"
[[body]]
name = "two"
shape = { cylinder = [2, 3] }
material = "a"
friction = 0.125
colour = [1, 1, 1]
fixed = true
[[force]]
kind = "wind"
force = [1, 2, 3]
[[force]]
kind = "drag"
body = "one"
linear = 4
angular = 5
[[force]]
kind = "point"
body = "one"
point = [1, 0, 0]
force = [0, 1, 0]
[[force]]
kind = "spring"
a = "one"
b = "two"
anchor_a = [1, 0, 0]
anchor_b = [0, 1, 0]
stiffness = 10
damping = 11
rest = 12
[camera]
eye = [1, 2, 3]
target = [3, 2, 1]
fov = 30
azimuth = 40
elevation = 50
[image]
size = [320, 240]
rate = 30
antialias = "ssaa2x2"
still = 1.25
[show]
path = true
theory = false
contact_forces = true
ladder = false
matrix = true
either_or = true
normals = true
velocities = true
forces = true
impacts = true
labels = true
boxes = true
planes = true
energy = true
glass = true
strobe = 0.5
)",
                                 "s.toml");
  CHECK(scene.title + scene.subtitle + scene.chapter + scene.claim == "TSCX");
  CHECK(scene.checks == std::vector<std::string>{"a", "b"});
  const WorldDef& world = scene.world;
  CHECK(world.gravity == Vec3(1.0, 2.0, 3.0));
  CHECK(world.method + world.impact == "steppingsequential");
  CHECK(world.duration == 7.0);
  CHECK(scene.seed == 9);
  CHECK(world.course.integrator == "midpoint");
  CHECK(world.course.step == 0.5);
  CHECK(world.stepping.step == 0.25);
  CHECK(world.stepping.solver == "pivoting");
  CHECK(world.stepping.tolerance == 1e-3);
  REQUIRE(world.pairs.size() == 1);
  CHECK(world.pairs[0].materialA + world.pairs[0].materialB == "ab");
  CHECK(world.pairs[0].restitution == 0.25);
  CHECK_FALSE(world.pairs[0].friction);

  const BodyDef &one = world.bodies.at(0), &two = world.bodies.at(1);
  CHECK(std::get<Box>(one.shape).half == Vec3(1.0, 2.0, 3.0));
  CHECK(one.density == 2.0);
  CHECK_FALSE(one.mass);
  CHECK(one.inertia == Vec3(1.0, 2.0, 3.0));
  CHECK(one.restitution == 0.5);
  CHECK(one.friction == 0.75);
  CHECK(one.position == Vec3(1.0, 2.0, 3.0));
  CHECK(one.velocity == Vec3(4.0, 5.0, 6.0));
  CHECK(one.angularVelocity == Vec3(7.0, 8.0, 9.0));
  CHECK(scene.colours[0] == Rgb{0.1, 0.2, 0.3});
  CHECK(scene.labels[0] == "L");
  CHECK(std::get<Cylinder>(two.shape).r == 2.0);
  CHECK(std::get<Cylinder>(two.shape).h == 3.0);
  CHECK(two.friction == 0.125);
  CHECK(two.restitution == 0.5);
  CHECK(two.fixed);
  CHECK(scene.colours[1] == Rgb{1.0, 1.0, 1.0});

  REQUIRE(world.forces.size() == 4);
  CHECK(std::get<UniformWind>(world.forces[0]).body == kNoBody);
  CHECK(std::get<UniformWind>(world.forces[0]).force == Vec3(1.0, 2.0, 3.0));
  CHECK(std::get<LinearDrag>(world.forces[1]).body == 0);
  CHECK(std::get<LinearDrag>(world.forces[1]).linear == 4.0);
  CHECK(std::get<LinearDrag>(world.forces[1]).angular == 5.0);
  CHECK(std::get<PointForce>(world.forces[2]).point_B == Vec3(1.0, 0.0, 0.0));
  CHECK(std::get<PointForce>(world.forces[2]).force == Vec3(0.0, 1.0, 0.0));
  const Spring& spring = std::get<Spring>(world.forces[3]);
  CHECK(spring.a == 0);
  CHECK(spring.b == 1);
  CHECK(spring.anchorA_B == Vec3(1.0, 0.0, 0.0));
  CHECK(spring.anchorB_B == Vec3(0.0, 1.0, 0.0));
  CHECK(spring.stiffness == 10.0);
  CHECK(spring.damping == 11.0);
  CHECK(spring.rest == 12.0);

  CHECK(scene.camera.eye == Vec3(1.0, 2.0, 3.0));
  CHECK(scene.camera.target == Vec3(3.0, 2.0, 1.0));
  CHECK(scene.camera.fov == 30.0);
  CHECK(scene.camera.azimuth == 40.0);
  CHECK(scene.camera.elevation == 50.0);
  CHECK(scene.image.width == 320);
  CHECK(scene.image.height == 240);
  CHECK(scene.image.rate == 30.0);
  CHECK(scene.image.antialias == "ssaa2x2");
  CHECK(scene.image.still == 1.25);
  const ShowFlags& show = scene.show;
  for (const bool flag :
       {show.path, show.contact_forces, show.matrix, show.either_or, show.normals, show.velocities,
        show.forces, show.impacts, show.labels, show.boxes, show.planes, show.energy, show.glass})
    CHECK(flag);
  CHECK_FALSE(show.theory);
  CHECK_FALSE(show.ladder);
  CHECK(show.strobe == 0.5);
}

TEST_CASE("either end of a spring may be fixed in the world") {
  const auto read = [](const std::string& ends) {
    const std::string text =
        "[world]\nduration = 1\n[[body]]\nname = \"ball\"\nshape = { sphere = 1 }\nmass = 1\n"
        "[[force]]\nkind = \"spring\"\nstiffness = 1\n" +
        ends;
    return std::get<Spring>(parseScene(text, "s.toml").world.forces.front());
  };
  for (const char* ends : {"a = \"ball\"\nanchor_a = [1, 0, 0]\nanchor_b = [0, 2, 0]",
                           "b = \"ball\"\nanchor_b = [1, 0, 0]\nanchor_a = [0, 2, 0]"}) {
    CAPTURE(ends);
    const Spring spring = read(ends);
    CHECK(spring.a == 0);
    CHECK(spring.b == kNoBody);
    CHECK(spring.anchorA_B == Vec3(1.0, 0.0, 0.0));
    CHECK(spring.anchorB_B == Vec3(0.0, 2.0, 0.0));
  }
}

TEST_CASE("a preset of stepping sets what the scene does not set itself") {
  const auto read = [](const std::string& lines) {
    const std::string text = "[world]\nduration = 1\n[stepping]\n" + lines +
                             "\n[[body]]\nname = \"ball\"\nshape = { sphere = 1 }\nmass = 1\n";
    return parseScene(text, "s.toml").world.stepping;
  };
  CHECK(read("").solver == "newton");
  CHECK(read("").tolerance == 1e-12);
  CHECK(read("").iterations == read("preset = \"exact\"").iterations);
  CHECK(read("preset = \"balanced\"").solver == "newton");
  CHECK(read("preset = \"balanced\"").tolerance == 1e-9);
  CHECK(read("preset = \"fast\"").crowdSolver == "pgs");
  CHECK(read("preset = \"fast\"").crowdIterations == 20);
  CHECK(read("preset = \"fast\"").divides);
  CHECK_FALSE(read("preset = \"draft\"").divides);
  const SteppingSettings mixed = read("tolerance = 1e-4\npreset = \"fast\"\nsolver = \"newton\"");
  CHECK(mixed.solver == "newton");
  CHECK(mixed.tolerance == 1e-4);
  CHECK(mixed.crowdSolver == "newton");
  CHECK(mixed.crowdTolerance == 1e-4);
}

TEST_CASE("a plane's normal is made a unit vector, its distance with it, and it is fixed") {
  const BodyDef floor = body("shape = { plane = [0, 3, 4, 10] }");
  const HalfSpace& plane = std::get<HalfSpace>(floor.shape);
  CHECK(plane.n == Vec3(0.0, 0.6, 0.8));
  CHECK(plane.d == 2.0);
  CHECK(floor.fixed);
}

// Oracle: closed form. Measured 1.2e-16, allowed 1e-15 for the rounding of a square root and a
// sine.
TEST_CASE("an orientation is the same by axis and degrees and by a quaternion of any length") {
  const BodyDef turned = body(kBallKeys + "orientation = { axis = [0, 0, 2], degrees = 90 }");
  CHECK((turned.orientation * Vec3::UnitX() - Vec3::UnitY()).norm() < 1e-15);
  const BodyDef same = body(kBallKeys + "orientation = [3, 0, 0, 3]");
  CHECK((turned.orientation.coeffs() - same.orientation.coeffs()).norm() < 1e-15);
}

// Oracle: closed form. Measured 2.3e-16, allowed 1e-15.
TEST_CASE("a spin given in the body frame is turned to the world frame") {
  const BodyDef spun = body(kBallKeys +
                            "orientation = { axis = [0, 0, 1], degrees = 90 }\n"
                            "angular_velocity_body = [2, 0, 0]");
  CHECK((spun.angularVelocity - Vec3(0.0, 2.0, 0.0)).norm() < 1e-15);
}

TEST_CASE("a body without a material's density may bring its own, and mass stands beside it") {
  CHECK(body("shape = { sphere = 1 }\ndensity = 3").density == 3.0);
  const BodyDef both = body("shape = { sphere = 1 }\ndensity = 3\nmass = 4");
  CHECK(both.density == 3.0);
  CHECK(both.mass == 4.0);
  CHECK_NOTHROW(body("shape = { sphere = 1 }\nfixed = true"));
}

TEST_CASE("bodies stand in the order of the file, arrays behind them") {
  const Scene scene = read(
      "[[array]]\nname = \"a\"\nkind = \"row\"\ncount = 2\nbody = { shape = { sphere = 1 }, mass = "
      "1 }\n"
      "[[body]]\nname = \"z\"\n" +
      kBallKeys + "[[body]]\nname = \"y\"\n" + kBallKeys);
  std::vector<std::string> names;
  for (const BodyDef& def : scene.world.bodies) names.push_back(def.name);
  CHECK(names == std::vector<std::string>{"z", "y", "a.0", "a.1"});
}
