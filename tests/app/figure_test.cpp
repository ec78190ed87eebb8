// The kit for figures: cameras, what frames the bodies, and which instants a sheet shows.
#include <algorithm>

#include "app/present/instants.h"
#include "app/present/present.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

// Falls for a second onto the floor and lies there for nine more.
const std::string kBoxDrop = R"(
title = "A drop"
[world]
duration = 10.0
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[body]]
name = "box"
shape = { box = [0.2, 0.2, 0.2] }
mass = 1.0
position = [0, 4, 0]
)";

}  // namespace

TEST_CASE(
    "a sheet shows the fall in equal parts and the rest once, and a still scene one picture") {
  const Scene scene = parseScene(kBoxDrop, "drop");
  const Recording recording = record(scene, 60.0);
  const std::vector<int> chosen = tellingSamples(scene, recording, 12);
  REQUIRE(chosen.size() == 12);
  CHECK(chosen.front() == 0);
  CHECK(recording.samples[chosen.back()].t < 1.0);
  CHECK(recording.samples[chosen.back()].bodies[1].x.y() == Approx(0.1).margin(1e-6));
  // Equal ways, to what one sample moves: at 9 m/s 0.15 m of 0.35 m.
  for (std::size_t n = 1; n < chosen.size(); ++n) {
    const double way = recording.samples[chosen[n - 1]].bodies[1].x.y() -
                       recording.samples[chosen[n]].bodies[1].x.y();
    CHECK(way == Approx(3.9 / 11.0).margin(0.16));
  }
  const Scene still = parseScene(kBoxDrop, "drop", {"body.box.position=[0,0.1,0]"});
  CHECK(tellingSamples(still, record(still, 60.0), 12) == std::vector<int>{0});
}

TEST_CASE("a camera that follows a body keeps it at its place on the image") {
  const Scene scene =
      parseScene(kBoxDrop + "[camera]\nfollow = \"box\"\n", "drop", {"world.duration=0.5"});
  const Recording recording = record(scene, 60.0);
  const Presenter presenter(scene, recording);
  const Projection start(presenter.image(0).camera, 1280.0, 720.0);
  const Projection later(presenter.image(25).camera, 1280.0, 720.0);
  const Vec3 from = recording.samples[0].bodies[1].x, to = recording.samples[25].bodies[1].x;
  REQUIRE((from - to).norm() > 0.5);
  CHECK((*start.project(from) - *later.project(to)).norm() < 1e-9);
  CHECK(presenter.strobe().camera.eye != presenter.image(0).camera.eye);
}

TEST_CASE("of several cameras the first is taken, and each needs a name of its own") {
  const std::string two =
      kBoxDrop + "[[camera]]\nname = \"a\"\nazimuth = 10\n[[camera]]\nname = \"b\"\nazimuth = 50\n";
  const Scene scene = parseScene(two, "drop");
  REQUIRE(scene.cameras.size() == 2);
  CHECK(scene.camera.azimuth == 10.0);
  CHECK(scene.cameras[1].azimuth == 50.0);
  CHECK_THROWS_AS(
      parseScene(kBoxDrop + "[[camera]]\nname = \"a\"\n[[camera]]\nname = \"a\"\n", "drop"),
      SceneError);
  CHECK_THROWS_AS(parseScene(kBoxDrop + "[[camera]]\nazimuth = 1\n", "drop"), SceneError);
  CHECK_THROWS_AS(parseScene(kBoxDrop + "[camera]\nfollow = \"bax\"\n", "drop"), SceneError);
}

TEST_CASE("floor, ruler and title can be left out") {
  const Scene scene =
      parseScene(kBoxDrop + "[show]\nfloor = false\ntitle = false\nruler = false\n", "drop");
  const Recording recording = record(scene, 60.0);
  const Presenter presenter(scene, recording);
  for (const Picture& picture : {presenter.image(3), presenter.strobe()}) {
    CHECK_FALSE(picture.floor.visible);
    CHECK_FALSE(picture.floor.rule);
    CHECK(picture.title.empty());
    CHECK(picture.subtitle.empty());
  }
}

// In a film it must not jump, nor differ from that of the strobe.
TEST_CASE("the ruler measures where bodies come in the run, in every picture of it") {
  const std::string thrown = "body.box.velocity=[2, 0, 0]";
  const Scene scene = parseScene(kBoxDrop, "drop", {thrown});
  const Recording recording = record(scene, 60.0);
  const Presenter presenter(scene, recording);
  const Eigen::AlignedBox3d whole = presenter.image(0).floor.motion;
  for (const Sample& sample : recording.samples) CHECK(whole.contains(sample.bodies[1].x));
  for (const Picture& picture : {presenter.image(3), presenter.still(0.5), presenter.strobe()})
    CHECK(picture.floor.motion.isApprox(whole, 0.0));
}

// Oracle: symmetry. In a film the words of bodies that move must not push the ruler about.
TEST_CASE("the ruler makes room for the same words in every picture of a run") {
  const Scene scene = parseScene(kBoxDrop + "[show]\nlabels = true\nimpacts = true\n", "drop");
  const Recording recording = record(scene, 60.0);
  const Presenter presenter(scene, recording);
  const Picture start = presenter.image(0);
  REQUIRE(!start.floor.labels.empty());
  for (const Picture& other : {presenter.image(30), presenter.image(90), presenter.strobe()}) {
    REQUIRE(other.floor.labels.size() == start.floor.labels.size());
    for (std::size_t i = 0; i < start.floor.labels.size(); ++i)
      CHECK(*other.floor.labels[i].anchor == *start.floor.labels[i].anchor);
    CHECK(other.floor.marks.size() == start.floor.marks.size());
  }
}

TEST_CASE("a slab of gel stands in place of the floor, with its top at the floor's height") {
  const Scene scene = parseScene(kBoxDrop + "[show]\ngel = 0.5\n", "drop");
  const Recording recording = record(scene, 60.0);
  const Presenter presenter(scene, recording);
  const Picture picture = presenter.image(0);
  CHECK(!picture.floor.visible);
  const auto glass = [](const Instance& instance) { return instance.finish == Finish::Glass; };
  REQUIRE(std::count_if(picture.instances.begin(), picture.instances.end(), glass) == 1);
  const Instance& slab = *std::find_if(picture.instances.begin(), picture.instances.end(), glass);
  CHECK(slab.position.y() + slab.scale.y() == Approx(0.0).margin(1e-15));
  CHECK(slab.scale.y() == 0.25);
  // Masks know bodies alone.
  CHECK(presenter.bodiesAlone(0).instances.size() == 1);
}
