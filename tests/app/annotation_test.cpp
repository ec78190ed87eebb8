// Ways, names and panes on pictures of runs.
#include <algorithm>

#include "app/present/present.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

const std::string kFloor = "[[body]]\nname = \"floor\"\nshape = { plane = [0, 1, 0, 0] }\n";

}  // namespace

// Oracle: the table. Half an image's time of free fall, g/(8·4²) m, is more than the ball is high.
TEST_CASE(
    "the way of what lies on a floor does not leave it between two samples, where it is hit") {
  const Scene scene = parseScene(
      "[world]\nduration = 1.0\n[image]\nrate = 4\n[show]\npath = true\n" + kFloor + R"([[body]]
name = "ball"
shape = { sphere = 0.02 }
mass = 1.0
position = [0, 0.02, 0]
[[body]]
name = "other"
shape = { sphere = 0.02 }
mass = 1.0
position = [-0.24, 0.02, 0]
velocity = [0.5, 0, 0]
)",
      "roll");
  const Recording recording = record(scene, scene.image.rate);
  const Picture picture = Presenter(scene, recording).image(4);
  int corners = 0;
  for (const Polyline& line : picture.lines)
    for (const Eigen::Vector3d& point : line.points) {
      CHECK(point.y() == Approx(0.02).margin(1e-9));
      ++corners;
    }
  CHECK(corners > 2 * 5);  // the hit is one of them
}

TEST_CASE("what bends has one name, and neither a way nor a pin for each of its points") {
  const Scene scene = parseScene(R"([world]
duration = 0.1
[[body]]
name = "pole"
shape = { box = [0.02, 1, 0.02] }
mass = 1.0
position = [-0.5, 0, 0]
[[cloth]]
name = "flag"
columns = 3
rows = 3
size = [0.4, 0.4]
pins = "column"
pin_to = "pole"
[[joint]]
kind = "distance"
a = "pole"
b = "flag.8"
anchor = [-0.5, -0.4, 0]
anchor_b = [0.2, 0, 0.2]
[show]
labels = true
path = true
)",
                                 "flag");
  REQUIRE(scene.world.joints.size() == 4);
  const Picture picture = Presenter(scene, record(scene, 60.0)).image(6);
  REQUIRE(picture.labels.size() == 2);
  CHECK(picture.labels.front().text == "pole");
  CHECK(picture.labels.back().text == "flag");
  CHECK(picture.lines.size() == 1);  // the way of the pole
  // The pole, the two sides of the flag, and the rod with a ball at each end.
  CHECK(picture.instances.size() == 6);
}

TEST_CASE("a pane that the eye is behind is seen by its edges, one before it whole") {
  const std::string side = GENERATE("1", "-1");
  const Scene scene = parseScene("[world]\nduration = 0.1\n[camera]\nazimuth = 90\n" + kFloor +
                                     "[[body]]\nname = \"wall\"\nshape = { plane = [" + side +
                                     ", 0, 0, -0.3] }\n" + R"([[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 1.0
position = [0, 0.1, 0]
)",
                                 "wall");
  const Picture picture = Presenter(scene, record(scene, 60.0)).image(0);
  const auto panes = std::count_if(picture.instances.begin(), picture.instances.end(),
                                   [](const Instance& one) { return one.finish == Finish::Glass; });
  CHECK(panes == (side == "1" ? 1 : 0));
  const auto edges = std::count_if(picture.lines.begin(), picture.lines.end(),
                                   [](const Polyline& line) { return line.points.size() == 5; });
  CHECK(edges == (side == "1" ? 0 : 1));
  for (const Polyline& line : picture.lines)
    for (const Eigen::Vector3d& point : line.points) CHECK(point.x() == Approx(0.3));
}
