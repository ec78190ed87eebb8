// Joints in pictures: where they are seen, and the arrows of their forces.
#include <algorithm>

#include "app/present/present.h"
#include "render/label_places.h"
#include "render/silhouette.h"
#include "tests/catch.h"

using namespace tumble;

// Oracle: geometry. A rod from the surface of the bob to the pivot, 1 m from its centre, both seen.
TEST_CASE("a pendulum is seen with its pivot and what leads there") {
  const std::string kind = GENERATE("kind = \"ball\"\nanchor = [0, 1.8, 0]\n",
                                    "kind = \"distance\"\nanchor = [0.8, 1.2, 0]\n"
                                    "anchor_b = [0, 1.8, 0]\n");
  const Scene scene = parseScene(
      "[world]\nduration = 1.0\n[[body]]\nname = \"bob\"\nmass = 1.0\n"
      "shape = { sphere = 0.1 }\nposition = [0.8, 1.2, 0]\n"
      "[[joint]]\na = \"bob\"\n" +
          kind,
      "pendulum");
  const Recording recording = record(scene, 10.0);
  const Presenter presenter(scene, recording);
  const Vec3 pivot(0.0, 1.8, 0.0);
  for (int k = 0; k < presenter.count(); ++k) {
    const Picture picture = presenter.image(k);
    const auto seen = Projection(picture.camera, 1280, 720).project(pivot);
    REQUIRE(seen);
    CHECK(Eigen::AlignedBox2d(Eigen::Vector2d(20, 80), Eigen::Vector2d(1260, 700))
              .contains(seen->head<2>()));
    const auto rod =
        std::find_if(picture.instances.begin(), picture.instances.end(),
                     [](const Instance& instance) { return instance.form == Form::Cylinder; });
    REQUIRE(rod != picture.instances.end());
    const Vec3 bob = recording.samples[static_cast<std::size_t>(k)].bodies[0].x;
    CHECK(rod->scale.y() == Approx(0.45).epsilon(1e-6));
    CHECK((rod->position - (pivot + 0.45 * (bob - pivot))).norm() < 1e-6);
  }
}

// Oracle: the forces that are put in. One of a hundred samples is the spike.
TEST_CASE("arrows of joint forces are as long as what lasts, and a spike is told in words") {
  const Scene scene = parseScene(R"([world]
duration = 0.2
[[body]]
name = "bob"
shape = { sphere = 0.1 }
mass = 1.0
position = [0, 1, 0]
[[joint]]
a = "bob"
kind = "ball"
anchor = [0, 1.5, 0]
[show]
joint_forces = true
)",
                                 "hung");
  const auto arrowsOf = [&](double spike) {
    Recording recording = record(scene, 500.0);
    for (Sample& sample : recording.samples)
      for (JointForce& joint : sample.joints) joint.force = {0.0, 10.0, 0.0};
    recording.samples[50].joints[0].force.y() = spike;
    const Presenter presenter(scene, recording);
    const Picture usual = presenter.image(10), struck = presenter.image(50);
    const auto length = [](const Picture& picture) {
      return (picture.arrows.at(0).tip - picture.arrows.at(0).base).norm();
    };
    const auto told =
        std::find_if(usual.remarks.begin(), usual.remarks.end(), [](const Remark& one) {
          return one.text == "arrows of joints end at 10.00 N; the largest is 5000 N, at 0.1 s";
        });
    return std::tuple(length(usual), length(struck), told != usual.remarks.end());
  };
  const auto [usual, struck, told] = arrowsOf(5000.0);
  const auto [low, high, quiet] = arrowsOf(25.0);
  CHECK(struck == Approx(usual));
  CHECK(told);
  CHECK(high == Approx(2.5 * low));  // no spike: in proportion
  CHECK(high == Approx(struck));
  CHECK_FALSE(quiet);
}

// Oracle: the scene. The bob of a rod hangs below the bar, which moves but does not lead to the
// world: what pulls the bob is drawn at the bob's end of the rod, not at the bar's.
TEST_CASE("the force on the outer body of a joint is drawn where it acts on that body") {
  const std::string order =
      GENERATE("a = \"bar\"\nb = \"bob\"\nanchor = [0, 2, 0]\nanchor_b = [0, 1, 0]\n",
               "a = \"bob\"\nb = \"bar\"\nanchor = [0, 1, 0]\nanchor_b = [0, 2, 0]\n");
  const Scene scene = parseScene(R"([world]
duration = 0.1
[[body]]
name = "bar"
shape = { box = [1, 0.2, 0.2] }
position = [0, 2, 0]
fixed = true
[[body]]
name = "bob"
shape = { sphere = 0.1 }
mass = 1.0
position = [0, 1, 0]
[show]
joint_forces = true
[[joint]]
kind = "distance"
)" + order,
                                 "hung");
  const Recording recording = record(scene, 60.0);
  const Picture picture = Presenter(scene, recording).image(2);
  REQUIRE(picture.arrows.size() == 1);
  CHECK((picture.arrows[0].base - Vec3(0, 1, 0)).norm() < 1e-6);
  CHECK(picture.arrows[0].tip.y() > 1.05);
}

// Oracle: the silhouette of the rod. Left of its right end, where the number wants to be, is the
// rod.
TEST_CASE("the number of a joint at the end of a flat rod stands off the rod") {
  const Scene scene = parseScene(R"([world]
duration = 0.1
[[body]]
name = "rod"
shape = { box = [2, 0.08, 0.3] }
mass = 2.0
position = [0, 1, 0]
[[body]]
name = "post"
shape = { box = [0.1, 1.0, 0.1] }
fixed = true
position = [0, 0, 0]
[show]
joint_forces = true
[[joint]]
a = "rod"
kind = "ball"
anchor = [-1, 1, 0]
[[joint]]
a = "rod"
kind = "ball"
anchor = [1, 1, 0]
)",
                                 "rod");
  const Recording recording = record(scene, 60.0);
  const Picture picture = Presenter(scene, recording).image(2);
  const Projection projection(picture.camera, 1280.0, 720.0);
  LabelPlaces places({1280.0, 720.0});
  for (const Instance& body : picture.instances) places.cover(*silhouetteOf(body, projection));
  const Silhouette rod = *silhouetteOf(picture.instances.at(0), projection);
  REQUIRE(picture.labels.size() == 2);
  for (const Label& label : picture.labels) {
    CHECK(label.text == "9.810 N");
    const Eigen::Vector2d anchor = projection.project(*label.anchor)->head<2>();
    const auto place = places.place(label, anchor, 55.0);
    REQUIRE(place);
    CHECK_FALSE(rod.meets(inkOf(place->pen, 55.0, label.size, label.align)));
  }
}
