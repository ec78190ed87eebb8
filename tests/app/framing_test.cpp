// A picture holds what it shows, and keeps no room for what it does not.
#include "app/present/framing.h"
#include "app/present/present.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

// The three levels of a tower, and a bob that swings at its right; to be shown are …
constexpr const char* kTowerAndBob = R"(
[world]
duration = 2.0
[[body]]
shape = { plane = [0, 1, 0, 0] }
[[array]]
name = "tower"
kind = "tower"
count = 3
body = { shape = { box = [0.5, 0.5, 0.5] }, mass = 1.0 }
[[body]]
name = "bob"
shape = { sphere = 0.1 }
mass = 1.0
position = [1.2, 0.7, 0.0]
[[joint]]
kind = "ball"
a = "bob"
anchor = [0.8, 1.6, 0.0]
[show]
)";

}  // namespace

// Oracle: geometry. Bars stand right of what swings beside the tower.
TEST_CASE("bars of a ladder stand on the way of no other body") {
  const Scene scene = parseScene(std::string(kTowerAndBob) + "contact_forces = true\n", "tower");
  const Recording recording = record(scene, 20.0);
  const Presenter presenter(scene, recording);
  for (const Picture& picture : {presenter.image(0), presenter.strobe()}) {
    REQUIRE(picture.pageBars.size() == 3);
    const Projection projection(picture.camera, 1280.0, 720.0);
    for (const Sample& sample : recording.samples)
      CHECK(projection.project(sample.bodies.back().x + Vec3(0.1, 0.0, 0.0))->x() <
            picture.pageBars[0].base.x());
  }
}

// Oracle: symmetry. What is not drawn takes no room.
TEST_CASE("room for a ladder is kept only where one stands") {
  const auto eyeWith = [](const std::string& more) {
    const Scene scene = parseScene(std::string(kTowerAndBob) + more, "tower");
    const Recording recording = record(scene, 20.0);
    return Presenter(scene, recording).image(0).camera.eye;
  };
  // Arrows of weights that are too short to be seen, so that they take no room either.
  CHECK(eyeWith("contact_forces = true\nladder = false\nforce_scale = 1e-9\n") ==
        eyeWith("contact_forces = false\n"));
}

// Oracle: geometry. A bob that swings pulls upward at its pin and flies to either side.
TEST_CASE("arrows stand inside the picture that frames itself") {
  const Scene scene =
      parseScene(std::string(kTowerAndBob) + "joint_forces = true\nvelocities = true\n", "tower");
  const Recording recording = record(scene, 20.0);
  const Presenter presenter(scene, recording);
  for (int k = 0; k < presenter.count(); ++k) {
    const Picture picture = presenter.image(k);
    const Projection projection(picture.camera, 1280.0, 720.0);
    for (const Arrow& arrow : picture.arrows) {
      const Vec3 tip = *projection.project(arrow.tip);
      CHECK((tip.x() > 0.0 && tip.x() < 1280.0));
      CHECK((tip.y() > titleHeight(scene) && tip.y() < 720.0));
    }
  }
}

// Oracle: by hand. The wedge is 1.6 times as long as the motion.
TEST_CASE("what stands and is not much longer than the motion is seen whole") {
  const Scene scene = parseScene(R"(
[world]
duration = 1.0
gravity = [0, 0, 0]
[[body]]
shape = { box = [4.0, 0.2, 0.2] }
fixed = true
[[body]]
shape = { sphere = 0.2 }
mass = 1.0
position = [0, 1, 0]
velocity = [2, 0, 0]
)",
                                 "bar");
  const Recording recording = record(scene, 20.0);
  const Picture picture = Presenter(scene, recording).image(0);
  const Projection projection(picture.camera, 1280.0, 720.0);
  CHECK(projection.project({-2.0, 0.0, 0.0})->x() > 0.0);
  CHECK(projection.project({2.0, 0.0, 0.0})->x() < 1280.0);
}

TEST_CASE("a camera that the scene places stays there for a strobe") {
  const Scene scene = parseScene(
      std::string(kTowerAndBob) + "[camera]\neye = [0, 1, 3]\ntarget = [0, 1, 0]\n", "tower");
  const Recording recording = record(scene, 20.0);
  const Presenter presenter(scene, recording);
  CHECK(presenter.strobe().camera.eye == Vec3(0.0, 1.0, 3.0));
  CHECK(presenter.strobe().camera.target == presenter.image(0).camera.target);
}
