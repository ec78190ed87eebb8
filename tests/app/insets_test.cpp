// What stands on the page beside contacts: the ladder of forces, the matrix A, either or.
#include "app/present/insets.h"

#include <algorithm>

#include "app/file/data.h"
#include "app/present/arrows.h"
#include "app/present/present.h"
#include "tests/app/runs.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

/// Cubes of 0.5 m and 1 kg on each other, as they are at the start.
Scene towerOf(int count, const std::vector<std::string>& overrides = {}) {
  return parseScene(R"(
[world]
method = "stepping"
duration = 0.02
[materials.card]
density = 8
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[array]]
name = "box"
kind = "tower"
count = )" + std::to_string(count) +
                        R"(
body = { shape = { box = [0.5, 0.5, 0.5] }, material = "card" }
[camera]
eye = [5, 30, 200]
target = [5, 25, 0]
[show]
contact_forces = true
)",
                    "tower.toml", overrides);
}

std::vector<PageShape> discsOf(const Picture& picture) {
  std::vector<PageShape> discs = picture.pageShapes;
  std::erase_if(discs, [](const PageShape& shape) { return shape.form != Flat::Disc; });
  return discs;
}

}  // namespace

// Oracle: by hand. A unit of force at a corner r of a cube of m = 1 kg, s = 0.5 m, I = m s²/6,
// lifts the corner r' by 1/m + (x x' + z z')/I: 4, 1, 1, −2 for the four; between two cubes twice
// that, and on the level above the same with the other sign. Measured 1e-15, allowed 1e-12.
TEST_CASE("the matrix of a tower is as worked out by hand") {
  const Scene scene = towerOf(2);
  const Recording recording = runOf(scene);
  const Sample& sample = recording.samples.front();
  const MatX A = contactMatrix(scene, sample);
  REQUIRE(A.rows() == 8);
  for (Eigen::Index i = 0; i < 8; ++i)
    for (Eigen::Index k = 0; k < 8; ++k) {
      const ContactSample &ci = sample.contacts[i], &ck = sample.contacts[k];
      const double cube = 1.0 + 24.0 * (ci.p.x() * ck.p.x() + ci.p.z() * ck.p.z());
      const double shared = ci.b == ck.b ? (ci.b == 0 ? 1.0 : 2.0) : -1.0;
      CAPTURE(i, k);
      CHECK(A(i, k) == Approx(shared * cube).margin(1e-12));
    }
  Picture picture;
  addContactMatrix(scene, sample, {800.0, 450.0}, picture);
  REQUIRE(picture.bar);
  CHECK(picture.bar->to == Approx(8.0).epsilon(1e-12));
  CHECK(std::count_if(picture.pageShapes.begin(), picture.pageShapes.end(),
                      [](const PageShape& s) { return s.form == Flat::Rectangle; }) == 64);
}

// Oracle: by hand. A plank of 6 kg, 2 m, on a hinge, I = m (L² + h²)/12 + m L²/4, is lifted at
// 0.6 m by F: a = 0.6 (0.6 F − m g)/I for F ≥ 98.1 N, else the prop gives 98.1 N − F. 1e-9.
TEST_CASE("a dot stands for either a force or an acceleration, never for both") {
  const std::string demo = dataFolder("demos") + "/free-or-not.toml";
  const double I = 6.0 * (4.0 + 0.0025) / 12.0 + 6.0;
  for (const double lift : {0.0, 60.0, 150.0}) {
    CAPTURE(lift);
    const Scene scene =
        readScene(demo, {"body.prop.position=[0.6, 0.25, 0.0]", "body.prop.velocity=[0, 0, 0]",
                         "world.duration=0.05", "body.ball.position=[3.1, 3.0, 0.0]",
                         "force.other.force=[0.0, " + std::to_string(lift) + ", 0.0]"});
    const Recording recording = runOf(scene);
    const Sample& sample = recording.samples.front();
    double force = 0.0, least = 1e9;
    const std::vector<double> a = contactAccelerations(scene, sample);
    REQUIRE_FALSE(a.empty());
    for (std::size_t i = 0; i < a.size(); ++i) {
      force += sample.contacts[i].force.y();
      least = std::min(least, a[i]);
    }
    CHECK(force == Approx(std::max(0.0, 98.1 - lift)).margin(1e-9));
    CHECK(least == Approx(std::max(0.0, 0.6 * (0.6 * lift - 6.0 * 9.81) / I)).margin(1e-9));

    // On the upper half-line, or on the other.
    Picture picture;
    addEitherOr(scene, recording, sample, {800.0, 450.0}, picture);
    const std::vector<PageShape> discs = discsOf(picture);
    REQUIRE(discs.size() == 2);  // a rim and a dot
    const Eigen::Vector2d origin(800.0 - 40.0 - 153.0, 0.13 * 450.0 + 153.0);
    CHECK((discs[1].from.x() > origin.x() + 1.0) == (lift > 98.1));
    CHECK((discs[1].from.y() < origin.y() - 1.0) == (lift < 98.1));
  }
}

// Oracle: the page itself. Whatever its form, rows keep apart and inside; the foot is among them.
TEST_CASE("the ladder of a tall tower fits on every page") {
  const Scene scene = towerOf(100);
  const Recording recording = runOf(scene);
  for (const Eigen::Vector2d& page :
       {Eigen::Vector2d(1280.0, 720.0), {800.0, 450.0}, {800.0, 600.0}, {480.0, 270.0}}) {
    Picture picture;
    picture.camera = {.eye = {5.0, 30.0, 200.0}, .target = {5.0, 25.0, 0.0}, .fov = 24.0};
    addForceLadder(scene, recording.samples.front(), page, {}, picture);
    REQUIRE(picture.pageBars.size() >= 4);
    CHECK(picture.pageBars.back().text == "981.0 N");
    double above = -1e9;
    for (const PageBar& row : picture.pageBars) {
      CAPTURE(page.transpose(), row.base.transpose(), row.length, row.text);
      CHECK(row.base.y() >= above + 20.0 - 1e-9);
      CHECK((row.base.y() > 20.0 && row.base.y() < page.y() - 20.0));
      CHECK((row.base.x() > 0.0 && row.base.x() + row.length + 70.0 < page.x()));
      above = row.base.y();
    }
    for (const Label& label : picture.labels)
      CHECK((label.offset.y() > 10.0 && label.offset.x() + 180.0 < page.x()));
  }
}

TEST_CASE("a scene may leave the ladder away, and ask for matrix and either-or") {
  const auto imageOf = [](const std::vector<std::string>& overrides) {
    const Scene scene = towerOf(3, overrides);
    const Recording recording = runOf(scene);
    return Presenter(scene, recording).image(0);
  };
  const Picture plain = imageOf({}), without = imageOf({"show.ladder=false"});
  CHECK(plain.pageBars.size() == 3);
  CHECK(without.pageBars.empty());
  CHECK(without.arrows.size() == plain.arrows.size());
  CHECK(plain.pageShapes.empty());
  CHECK(imageOf({"show.matrix=true"}).pageShapes.size() >= 144);
  CHECK(discsOf(imageOf({"show.either_or=true"})).size() == 6);
}
