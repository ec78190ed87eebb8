// Pictures say what the recording says.
#include <algorithm>
#include <cmath>

#include "app/present/arrows.h"
#include "app/present/bodies.h"
#include "app/present/digits.h"
#include "app/present/labels.h"
#include "app/present/palette.h"
#include "app/present/present.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

constexpr const char* kFalling = R"(
title = "Falling"
[world]
duration = 1.0
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, -3] }
[[body]]
name = "brick"
shape = { box = [0.4, 0.1, 0.3] }
mass = 1.0
restitution = 0.25
label = "{name}: {restitution}"
velocity = [1.0, 0.0, 0.0]
[show]
path = true
strobe = 0.1
)";

int countOf(const Picture& picture, Finish finish) {
  int count = 0;
  for (const Instance& instance : picture.instances) count += instance.finish == finish;
  return count;
}

}  // namespace

TEST_CASE("a strobe shows a ghost every interval, older ones paler, and the last pose solid") {
  const Scene scene = parseScene(kFalling, "falling");
  const Recording recording = record(scene, 60.0);
  const Picture picture = Presenter(scene, recording).strobe();
  CHECK(countOf(picture, Finish::Ghost) == 10);
  CHECK(countOf(picture, Finish::Solid) == 1);
  for (std::size_t k = 0; k < 10; ++k) {
    CHECK(picture.instances[k].position == recording.samples[6 * k].bodies[1].x);
    if (k > 0) CHECK(picture.instances[k].alpha > picture.instances[k - 1].alpha);
  }
  CHECK(picture.instances.back().position == recording.samples.back().bodies[1].x);
  // One body alone is coloured by time, and the bar says so.
  REQUIRE(picture.bar.has_value());
  CHECK(picture.bar->to == 1.0);
  CHECK(picture.instances.front().colour == timeStops().front());
}

// Oracle: its own motion, 0.5 m/s along X.
TEST_CASE("what is led past leaves ghosts in a strobe, what stands leaves none") {
  const Scene scene = parseScene(R"(
[world]
duration = 1.0
[[body]]
name = "post"
shape = { box = [0.1, 1.0, 0.1] }
fixed = true
position = [0.0, 0.0, 2.0]
[[body]]
name = "led"
shape = { sphere = 0.1 }
fixed = true
velocity = [0.5, 0.0, 0.0]
[show]
strobe = 0.5
)",
                                 "led");
  const Recording recording = record(scene, 60.0);
  const Picture picture = Presenter(scene, recording).strobe();
  REQUIRE(countOf(picture, Finish::Ghost) == 2);
  for (std::size_t k = 0; k < 2; ++k)
    CHECK((picture.instances[k].position - Vec3(0.25 * static_cast<double>(k), 0.0, 0.0)).norm() <
          1e-12);
}

TEST_CASE("an image shows its sample's poses and time, on the floor where the scene has it") {
  const Scene scene = parseScene(kFalling, "falling");
  const Recording recording = record(scene, 60.0);
  const Presenter presenter(scene, recording);
  REQUIRE(presenter.count() == 61);
  const Picture picture = presenter.image(30);
  REQUIRE(picture.instances.size() == 1);
  CHECK(picture.instances[0].position == recording.samples[30].bodies[1].x);
  CHECK(picture.instances[0].scale == Vec3(0.2, 0.05, 0.15));
  CHECK(picture.floor.visible);
  CHECK(picture.floor.height == -3.0);
  CHECK(picture.subtitle == "t = 0.50 s");
  REQUIRE(picture.lines.size() == 1);
  CHECK(picture.lines[0].points.size() == 31);
  CHECK(picture.lines[0].points.back() == picture.instances[0].position);
  // The nearest sample, also beyond the ends.
  CHECK(presenter.still(0.508).instances[0].position == recording.samples[30].bodies[1].x);
  CHECK(presenter.still(99.0).instances[0].position == recording.samples[60].bodies[1].x);
}

TEST_CASE("the camera sees every pose of the whole motion inside the page") {
  const Scene scene = parseScene(kFalling, "falling");
  const Recording recording = record(scene, 60.0);
  const Picture picture = Presenter(scene, recording).image(0);
  const Projection projection(picture.camera, 1280.0, 720.0);
  for (const Eigen::Vector3d& point : motionPoints(scene, recording)) {
    const std::optional<Eigen::Vector3d> pixel = projection.project(point);
    REQUIRE(pixel.has_value());
    CHECK(pixel->x() > 0.05 * 1280.0);
    CHECK(pixel->x() < 0.95 * 1280.0);
    CHECK(pixel->y() > 0.13 * 720.0);
    CHECK(pixel->y() < 0.87 * 720.0);
  }
}

// Twelve edges, each of the box's own length: 4 (a + b + c) in all, drawn without gaps.
TEST_CASE("a bounding box is drawn with all its edges") {
  const Scene scene = parseScene(kFalling, "falling", {"show.boxes=true", "show.path=false"});
  const Recording recording = record(scene, 60.0);
  const Picture picture = Presenter(scene, recording).image(0);
  double length = 0.0;
  for (const Polyline& line : picture.lines)
    for (std::size_t k = 1; k < line.points.size(); ++k)
      length += (line.points[k] - line.points[k - 1]).norm();
  CHECK(length == Approx(4.0 * (0.4 + 0.1 + 0.3)).epsilon(1e-12));
}

TEST_CASE("wind and velocity arrows point along, end on the body and grow with what they show") {
  const Scene scene = parseScene(kFalling, "falling");
  Sample sample;
  sample.bodies.resize(2);
  sample.bodies[1].v = {3.0, 0.0, 0.0};
  Recording recording;
  recording.samples = {sample, sample};
  recording.samples[1].bodies[1].v = {0.0, 6.0, 0.0};
  Picture picture;
  addVelocities(scene, sample, fastestOf(scene, recording), 1.0, picture);
  REQUIRE(picture.arrows.size() == 1);
  CHECK((picture.arrows[0].base - Vec3(0.2, 0.0, 0.0)).norm() < 1e-15);
  CHECK((picture.arrows[0].tip - Vec3(0.7, 0.0, 0.0)).norm() < 1e-15);

  Scene windy = scene;
  windy.world.forces = {UniformWind{kNoBody, {0.0, 0.0, 5.0}}};
  Picture blown;
  addForces(windy, sample, 0.3, blown);
  REQUIRE(blown.arrows.size() == 1);
  CHECK((blown.arrows[0].tip - Vec3(0.0, 0.0, -0.15)).norm() < 1e-15);
  CHECK((blown.arrows[0].base - Vec3(0.0, 0.0, -0.45)).norm() < 1e-15);
}

TEST_CASE("labels give the values of their body") {
  const Scene scene = parseScene(kFalling, "falling");
  CHECK(labelOf(scene, 1) == "brick: 0.25");
  CHECK(labelOf(scene, 0).empty());
}

TEST_CASE("labels and colours of a varied array tell the restitution that acts, not a body's own") {
  const std::string row = R"(
[world]
[materials.rubber]
density = 1.0
[materials.floor]
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
material = "floor"
[[array]]
name = "ball"
kind = "row"
count = 2
step = [1, 0, 0]
vary = { restitution = [0.2, 0.6] }
body = { shape = { sphere = 0.1 }, material = "rubber", position = [0, 1, 0], label = "{restitution}" }
)";
  const Scene own = parseScene(row, "row");
  CHECK(labelOf(own, 1) == "0.2");
  CHECK(labelOf(own, 2) == "0.6");
  CHECK(bodyColours(own)[1] != bodyColours(own)[2]);
  const Scene pair = parseScene(row + "[pairs]\nrubber-floor = { restitution = 0.9 }\n", "row");
  CHECK(labelOf(pair, 1) == "0.9");
  CHECK(labelOf(pair, 2) == "0.9");
  CHECK(bodyColours(pair)[1] == bodyColours(pair)[2]);
}

// Points at the edge of a cloth weigh half of one inside, and pinned ones stand; it is one thing.
TEST_CASE("a cloth without a colour has that of the palette, and a back that can be told from it") {
  const std::string sheet = R"([world]
[[cloth]]
name = "a"
columns = 3
rows = 3
size = [0.2, 0.2]
pins = [[0, 0], [2, 0]]
[[cloth]]
name = "b"
columns = 3
rows = 3
size = [0.2, 0.2]
position = [0, 1, 0]
)";
  const Scene scene = parseScene(sheet, "sheet");
  const std::vector<Colour> colours = bodyColours(scene);
  REQUIRE(colours.size() == 18);
  for (std::size_t p = 0; p < 9; ++p) {
    CHECK(colours[p] == hex(0x3A6FA8));
    CHECK(colours[9 + p] == hex(0xE8BE57));
  }
  const auto light = [](const Colour& c) { return (c[0] + c[1] + c[2]) / 3.0f; };
  CHECK(light(backOfCloth(colours[0])) > light(colours[0]) + 0.2f);
  const Colour pale = hex(0xF0EEE8);
  CHECK(light(backOfCloth(pale)) < light(pale) - 0.2f);
}

TEST_CASE("a half-space that is a wall is a pane, a floor none, and what moves is as it was") {
  const Scene scene = parseScene(R"([world]
duration = 0.1
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[body]]
name = "wall"
shape = { plane = [1, 0, 0, -1] }
[[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 1.0
position = [0, 1, 0]
)",
                                 "walled");
  const Recording recording = record(scene, 60.0);
  const Picture picture = Presenter(scene, recording).image(0);
  REQUIRE(picture.instances.size() == 2);
  CHECK(picture.instances[0].finish == Finish::Glass);
  CHECK(picture.instances[1].finish == Finish::Solid);
  CHECK(picture.floor.visible);
}

TEST_CASE("only what turns in the run has a band to see it by") {
  const char* const scene = R"(
[world]
duration = 0.2
[[body]]
name = "still"
shape = { sphere = 0.1 }
mass = 1
[[body]]
name = "spinning"
shape = { sphere = 0.1 }
mass = 1
position = [1, 0, 0]
angular_velocity = [0, 3, 0]
)";
  const Scene balls = parseScene(scene, "balls");
  const Recording recording = record(balls, 60.0);
  const Picture picture = Presenter(balls, recording).strobe();
  for (const Instance& ball : picture.instances) CHECK(ball.banded == (ball.position.x() > 0.5));
}

TEST_CASE("force arrows are as long as their force is large, and point up from the contact") {
  Sample sample;
  sample.contacts = {{1, 0, {0.0, 0.0, 0.0}, Vec3::UnitY(), 0.0, {0.0, 10.0, 0.0}},
                     {2, 1, {1.0, 0.0, 0.0}, Vec3::UnitY(), 0.0, {0.0, 2.5, 0.0}},
                     {3, 2, {2.0, 0.0, 0.0}, Vec3(-Vec3::UnitY()), 0.0, {0.0, -5.0, 0.0}}};
  Picture picture;
  addContactForces(sample, 10.0, 0.44, picture);
  REQUIRE(picture.arrows.size() == 3);
  CHECK(picture.arrows[0].tip == Vec3(0.0, 0.44, 0.0));
  CHECK((picture.arrows[1].tip - Vec3(1.0, 0.11, 0.0)).norm() < 1e-15);
  // A force that presses the upper body's neighbour down is drawn on the upper body.
  CHECK((picture.arrows[2].tip - Vec3(2.0, 0.22, 0.0)).norm() < 1e-15);
}

TEST_CASE(
    "the forces of grains of dust have arrows too, and what rounding leaves of none has not") {
  Recording recording;
  const auto pushed = [](double force) {
    return ContactSample{1, 0, Vec3::Zero(), Vec3::UnitY(), 0.0, {0.0, force, 0.0}};
  };
  recording.samples.resize(1);
  CHECK(largestContactForce(recording) == 1.0);
  recording.samples[0].contacts = {pushed(0.0), pushed(3e-17)};
  CHECK(largestContactForce(recording) == 3e-17);
  recording.samples[0].contacts.assign(200, pushed(1e-14));
  recording.samples[0].contacts.push_back(pushed(10.0));
  CHECK(largestContactForce(recording) == 10.0);
}

TEST_CASE("a time on a picture has two digits of how long the run is, and hundredths at least") {
  CHECK(instant(0.5, 1.0) == "0.50");
  CHECK(instant(12.345, 60.0) == "12.35");
  CHECK(instant(0.5, 0.1) == "0.50");
  CHECK(instant(0.0213, 0.0632) == "0.021");
  CHECK(instant(0.00123, 0.002) == "0.0012");
  CHECK(instant(0.00123, 0.002, 1) == "0.00123");
}

TEST_CASE("the ladder sums each level of the tallest tower, top first, and keeps rows apart") {
  const Scene scene = parseScene(R"(
[world]
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[array]]
name = "two"
kind = "tower"
count = 2
body = { shape = { box = [0.5, 0.5, 0.5] }, mass = 1.0 }
[[array]]
name = "three"
kind = "tower"
count = 3
base = [2, 0, 0]
body = { shape = { box = [0.5, 0.5, 0.5] }, mass = 1.0 }
)",
                                 "towers");
  // Bodies 1, 2 and 3, 4, 5; two points a level that carry half of 10 N per body above each.
  Sample sample;
  for (const auto& [a, b, above] :
       {std::tuple(1, 0, 2), {2, 1, 1}, {3, 0, 3}, {4, 3, 2}, {5, 4, 1}})
    for (const double side : {-0.25, 0.25}) {
      const double height = b == 0 ? 0.0 : scene.world.bodies[b].position.y() + 0.25;
      sample.contacts.push_back({a,
                                 b,
                                 {scene.world.bodies[a].position.x() + side, height, 0.0},
                                 Vec3::UnitY(),
                                 0.0,
                                 {0.0, 5.0 * above, 0.0}});
    }
  Picture picture;
  picture.camera = {.eye = {2.0, 1.0, 8.0}, .target = {2.0, 1.0, 0.0}, .fov = 24.0};
  addForceLadder(scene, sample, {1280.0, 720.0}, {}, picture);
  REQUIRE(picture.pageBars.size() == 3);
  CHECK(picture.pageBars[0].text == "10.00 N");
  CHECK(picture.pageBars[1].text == "20.00 N");
  CHECK(picture.pageBars[2].text == "30.00 N");
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(picture.pageBars[k].length == Approx(220.0 * (k + 1.0) / 3.0));
    CHECK(picture.pageBars[k].leader->x() == 2.25);
  }
  CHECK(picture.pageBars[1].base.y() >= picture.pageBars[0].base.y() + 20.0);
}

TEST_CASE("colours: each body its own, fixed ones grey, along cividis where an array varies") {
  const Scene scene = parseScene(R"(
[world]
[materials.a]
density = 1.0
[materials.b]
density = 1.0
colour = [1.0, 0.5, 0.0]
[[body]]
name = "post"
shape = { sphere = 0.1 }
position = [0, 9, 0]
fixed = true
[[body]]
name = "one"
shape = { sphere = 0.1 }
material = "a"
[[body]]
name = "two"
shape = { sphere = 0.1 }
position = [1, 0, 0]
material = "a"
[[body]]
name = "orange"
shape = { sphere = 0.1 }
position = [2, 0, 0]
material = "b"
[[array]]
name = "ball"
kind = "row"
count = 3
step = [0, 0, 1]
vary = { restitution = [0.2, 0.8] }
body = { shape = { sphere = 0.1 }, position = [4, 0, 0], material = "a" }
)",
                                 "colours");
  const std::vector<Colour> colours = bodyColours(scene);
  CHECK(colours[0] == colour::kFixed);
  CHECK(colours[1] != colours[2]);
  CHECK(colours[3] == Colour{1.0f, 0.5f, 0.0f});
  CHECK(colours[4] == cividisStops().front());
  CHECK(colours[5] == ramp(cividisStops(), 0.5));
  CHECK(colours[6] == cividisStops().back());
}
