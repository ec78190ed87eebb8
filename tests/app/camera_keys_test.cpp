// Cameras that go through key frames, and words on pictures.
#include "app/present/camera_keys.h"

#include "app/present/present.h"
#include "tests/app/complaint.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

const std::string kFall = R"(
[world]
duration = 2.0
gravity = [0, 0, 0]
[[body]]
name = "ball"
shape = { sphere = 0.2 }
mass = 1.0
position = [0, 1, 0]
velocity = [1, 0, 0]
)";

// What is written on a picture that a scene asks for.
std::vector<std::string> textsOf(const Picture& picture) {
  std::vector<std::string> texts;
  for (const Label& label : picture.labels) texts.push_back(label.text);
  return texts;
}

}  // namespace

// Oracle: Hermite's cubic by hand.
TEST_CASE("a camera goes through its keys smoothly, and stands still before and after") {
  const Scene scene = parseScene(kFall + R"(
[camera]
keys = [ { at = 0.5, eye = [0, 1, 8], target = [0, 1, 0] },
         { at = 1.0, eye = [1, 1, 8], target = [0, 1, 0], fov = 30 },
         { at = 1.5, eye = [2, 1, 8], target = [0, 1, 0] } ]
)",
                                 "keys");
  const std::vector<CameraKey>& keys = scene.camera.keys;
  REQUIRE(keys.size() == 3);
  CHECK(cameraAt(keys, 0.0).eye == Vec3(0, 1, 8));
  CHECK(cameraAt(keys, 9.0).eye == Vec3(2, 1, 8));
  CHECK(cameraAt(keys, 1.0).eye == Vec3(1, 1, 8));
  CHECK(cameraAt(keys, 1.0).fov == 30.0);
  // From 0 to 1 with rates 0 and 2 1/s in 0.5 s: u²(3 − 2u) − u²(1 − u) at u = 1/2.
  CHECK(cameraAt(keys, 0.75).eye.x() == Approx(0.5 - 0.125).margin(1e-15));
  // No kink at the middle key.
  const double h = 1e-6;
  const double before = (cameraAt(keys, 1.0).eye.x() - cameraAt(keys, 1.0 - h).eye.x()) / h;
  const double after = (cameraAt(keys, 1.0 + h).eye.x() - cameraAt(keys, 1.0).eye.x()) / h;
  CHECK(before == Approx(2.0).margin(1e-4));
  CHECK(after == Approx(2.0).margin(1e-4));

  const Recording recording = record(scene, 60.0);
  const Presenter presenter(scene, recording);
  CHECK(presenter.image(60).camera.eye == Vec3(1, 1, 8));
  CHECK(presenter.image(0).camera.eye == Vec3(0, 1, 8));
}

TEST_CASE("a camera with one key stands there, and its strobe shows the whole motion") {
  const Scene scene = parseScene(
      kFall + "[camera]\nkeys = [ { at = 0, eye = [0, 1, 1], target = [0, 1, 0] } ]\n", "still");
  const Recording recording = record(scene, 60.0);
  const Presenter presenter(scene, recording);
  CHECK(presenter.image(0).camera.eye == Vec3(0, 1, 1));
  CHECK(presenter.image(60).camera.eye == Vec3(0, 1, 1));
  CHECK(presenter.strobe().camera.eye != Vec3(0, 1, 1));
}

TEST_CASE("keys of a camera that make no sense are refused with their place") {
  CHECK(complaint(kFall + "[camera]\nkeys = [ { at = 1, eye = [0, 1, 8], target = [0, 1, 0] }, "
                          "{ at = 1, eye = [0, 1, 9], target = [0, 1, 0] } ]\n")
            .find("not after the key before it") != std::string::npos);
  CHECK(complaint(kFall + "[camera]\nfollow = \"ball\"\nkeys = [ { at = 0, eye = [0, 1, 8], target "
                          "= [0, 1, 0] }, { at = 1, eye = [0, 1, 9], target = [0, 1, 0] } ]\n")
            .find("camera.follow: a camera with `keys`") != std::string::npos);
  CHECK(complaint(kFall + "[camera]\nkeys = [ { at = 0, eye = [0, 1, 8] }, { at = 1, eye = [0, 1, "
                          "9], target = [0, 1, 0] } ]\n")
            .find("camera.keys.0.target: missing") != std::string::npos);
}

// Oracle: geometry. A ball's silhouette ends a radius to the right of its centre, as the camera
// sees it.
TEST_CASE("words of a body stand beside it, and keep off arrows, unless they have a place") {
  const Scene scene = parseScene(kFall + R"(
[[text]]
text = "beside"
body = "ball"
[[text]]
text = "where I say"
body = "ball"
offset = [8, 5]
)",
                                 "words");
  const Recording recording = record(scene, 60.0);
  const Picture picture = Presenter(scene, recording).image(0);
  const Vec3 centre = recording.samples[0].bodies[0].x;
  const double radius = std::get<Sphere>(scene.world.bodies[0].shape).r;
  const Vec3 right = Projection(picture.camera, 1280.0, 720.0).right();
  REQUIRE(std::abs(right.z()) > 0.1);  // or X would do
  REQUIRE(picture.labels.size() == 2);
  CHECK((*picture.labels[0].anchor - centre - radius * right).norm() < 1e-12);
  CHECK(picture.labels[0].apart);
  CHECK(*picture.labels[1].anchor == centre);
  CHECK(!picture.labels[1].apart);
}

TEST_CASE("words stand on the pictures of their time, with a body, at a point or on the page") {
  const Scene scene = parseScene(kFall + R"(
[[text]]
text = "here it is"
body = "ball"
offset = [0, -30]
[[text]]
text = "later"
point = [1, 2, 3]
from = 1.0
[[text]]
text = "on the page"
page = [40, 600]
size = 24
bold = true
until = 0.5
)",
                                 "words");
  const Recording recording = record(scene, 60.0);
  const Presenter presenter(scene, recording);
  CHECK(textsOf(presenter.image(0)) == std::vector<std::string>{"here it is", "on the page"});
  CHECK(textsOf(presenter.image(90)) == std::vector<std::string>{"here it is", "later"});
  const Picture late = presenter.image(90);
  CHECK((*late.labels[0].anchor - Vec3(1.5, 1, 0)).norm() < 1e-12);
  CHECK(late.labels[0].offset == Eigen::Vector2d(0, -30));
  CHECK(*late.labels[1].anchor == Vec3(1, 2, 3));
  const Label page = presenter.image(0).labels[1];
  CHECK(!page.anchor);
  CHECK(page.offset == Eigen::Vector2d(40, 600));
  CHECK(page.size == 24.0f);
  CHECK(page.bold);
  CHECK(complaint(kFall + "[[text]]\ntext = \"a\"\nbody = \"bal\"\n").find("did you mean") !=
        std::string::npos);
  CHECK(complaint(kFall + "[[text]]\ntext = \"a\"\nbody = \"ball\"\npage = [1, 2]\n")
            .find("expected one of") != std::string::npos);
  CHECK(complaint(kFall + "[[text]]\npage = [1, 2]\n").find("expected what is to be read") !=
        std::string::npos);
}
