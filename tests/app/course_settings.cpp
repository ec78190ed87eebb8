// Settings of the course and pivots, from the file to the world and to the picture.
#include <cmath>

#include "app/present/present.h"
#include "sim/math/rotation.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

constexpr const char* kBrickAndTop = R"([world]
method = "course"
gravity = [0, 0, 0]
duration = 2.0
[course]
integrator = "euler"
step = 0.002
order = 9
attitude = "matrix"
[[body]]
name = "brick"
shape = { box = [0.2, 0.4, 0.6] }
mass = 1.0
angular_velocity = [3.0, 1.0, -2.0]
[[body]]
name = "top"
shape = { sphere = 0.1 }
mass = 1.0
position = [5, 0, 0]
pivot_body = [0, -0.2, 0]
)";

std::string settingsRefusal(const std::vector<std::string>& overrides) {
  try {
    makeWorld(parseScene(kBrickAndTop, "s.toml", overrides));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("order, attitude and pivot go from the file into the world") {
  const Scene scene = parseScene(kBrickAndTop, "s.toml");
  CHECK(scene.world.course.order == 9);
  CHECK(scene.world.course.attitude == "matrix");
  CHECK_FALSE(scene.world.bodies[0].pivot_B);
  REQUIRE(scene.world.bodies[1].pivot_B);
  CHECK(*scene.world.bodies[1].pivot_B == Vec3(0.0, -0.2, 0.0));
  const World world = makeWorld(scene);
  REQUIRE(world.model().pivots.size() == 1);
  CHECK(world.model().pivots[0].p == Vec3(5.0, -0.2, 0.0));
  CHECK(world.features().back() == "pivots");
}

TEST_CASE("what a world cannot integrate or hold is told at its key") {
  CHECK(settingsRefusal({}).empty());
  CHECK(settingsRefusal({"body.top.fixed=true"}) ==
        "s.toml:20:14: error: \"top\" is fixed; leave out the pivot or let it move");
  CHECK(settingsRefusal({"world.method=stepping"})
            .find("s.toml:20:14: error: \"stepping\" knows no pivots") == 0);
  CHECK(
      settingsRefusal({"course.integrator=taylor"}) ==
      "--set course.integrator=taylor: error: \"taylor\" needs a Taylor jet, which this scene does "
      "not offer");
  CHECK(settingsRefusal({"course.integrator=taylor", "course.attitude=quaternion"}).empty());
  CHECK(settingsRefusal({"course.step=1e-12"}) ==
        "--set course.step=1e-12: error: more than 1e11 steps would lead to the end; take longer "
        "ones");
}

// Oracle: R itself. The corners of what is drawn are where the matrix has them, to the single
// precision of pictures; the nearest rotation alone would miss by more than a millimetre.
TEST_CASE("a body that has sheared is drawn sheared") {
  const Scene scene = parseScene(kBrickAndTop, "s.toml");
  const Recording recording = record(scene, 10.0);
  const Presenter presenter(scene, recording);
  const Picture picture = presenter.image(presenter.count() - 1);
  const BodySample& body = recording.samples.back().bodies[0];
  REQUIRE(body.R);
  const Instance& brick = picture.instances[0];
  REQUIRE(brick.form == Form::Facets);
  double worst = 0.0, shear = 0.0;
  for (int k = 0; k < 8; ++k) {
    const Vec3 p(k & 1 ? 0.1 : -0.1, k & 2 ? 0.2 : -0.2, k & 4 ? 0.3 : -0.3);
    const Vec3 expected = body.x + *body.R * p;
    double nearest = 1.0;
    for (const Facets::Corner& corner : brick.facets->corners) {
      const Vec3 drawn = brick.position + brick.orientation * corner.position.cast<double>();
      nearest = std::min(nearest, (drawn - expected).norm());
    }
    worst = std::max(worst, nearest);
    shear = std::max(shear, (body.q * p + body.x - expected).norm());
  }
  CAPTURE(worst, shear);
  CHECK(worst < 1e-6);
  CHECK(shear > 1e-3);
}
