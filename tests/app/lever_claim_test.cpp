// The claims of levers and grooves hold for true runs, whatever the scene, and fail for untrue
// ones.
#include <algorithm>
#include <cmath>

#include "app/claim/rows.h"
#include "app/claim/verdict.h"
#include "app/panel/page.h"
#include "app/present/present.h"
#include "app/record/output.h"
#include "tests/app/claims.h"
#include "tests/app/runs.h"

using namespace tumble;

namespace {

bool checkHolds(const char* check, const std::vector<std::string>& overrides) {
  const Scene scene = demo("free-or-not", overrides);
  CAPTURE(scene.line);
  return holds(check, scene, record(scene, scene.image.rate));
}

}  // namespace

// Oracles: the closed forms of app/claim/lever.cpp and groove.cpp.
TEST_CASE("a lever and a groove keep their claims whatever the scene") {
  for (const char* method : {"course", "exact"}) {
    const std::string set = std::string("world.method=") + method;
    CHECK(checkHolds("lever", {set}));
    CHECK(checkHolds("lever", {set, "world.gravity=[0.0, -1.6, 0.0]", "body.plank.mass=0.3"}));
    CHECK(checkHolds(
        "lever", {set, "body.prop.position=[1.9, 0.25, 0.0]", "body.prop.velocity=[-0.3, 0, 0]"}));
    CHECK(checkHolds("lever", {set, "force.other.force=[0.0, 50.0, 0.0]"}));
    CHECK(checkHolds("groove", {set}));
    CHECK(checkHolds("groove", {set, "body.ball.mass=7.0", "world.gravity=[0.0, -1.6, 0.0]"}));
  }
}

// Oracle: by hand. Between planes of 30° and 60° they carry m g cos 30° and m g sin 30°.
TEST_CASE("a ball between two planes has a groove's claim, at any angle") {
  const Scene scene = parseScene(
      "[world]\nduration = 0.1\n[[body]]\nname = \"gentle\"\n"
      "shape = { plane = [0.5, 0.8660254037844386, 0, 0] }\n[[body]]\nname = \"steep\"\n"
      "shape = { plane = [-0.8660254037844386, 0.5, 0, 0] }\n[[body]]\nname = \"ball\"\n"
      "shape = { sphere = 0.2 }\nmass = 3\n"
      "position = [-0.07320508075688772, 0.2732050807568877, 0]\n",
      "s.toml");
  const std::vector<ClaimRow> rows = grooveRows(scene, record(scene, 60.0));
  REQUIRE(rows.size() == 2);
  for (const ClaimRow& row : rows) {
    CHECK(row.holds());
    const double share = row.label.find("gentle") != std::string::npos ? std::sqrt(0.75) : 0.5;
    CHECK(row.exact == Approx(3.0 * 9.81 * share).epsilon(1e-12));
  }
}

// Oracle: the same closed forms, for a force that obeys a f + b ≥ 0 and f ≥ 0, and is none that a
// contact gives.
TEST_CASE("a force that is too large lifts a plank, and its prop gives nothing") {
  const std::vector<std::string> lifted = {
      "body.prop.position=[0.6, 0.25, 0.0]", "body.prop.velocity=[0.0, 0.0, 0.0]",
      "force.other.force=[0.0, 150.0, 0.0]", "world.duration=0.3"};
  const Scene scene = demo("free-or-not", lifted);
  CHECK(holds("lever", scene, record(scene, 60.0)));
  const Verdict verdict = judge(scene, record(scene, 60.0));
  CHECK(std::any_of(verdict.rows.begin(), verdict.rows.end(), [](const ClaimRow& row) {
    return row.label.find("is lifted") != std::string::npos && row.measured == 1.0;
  }));
}

// Oracle: the tampering. The row tells the distance d of the prop where it is furthest off.
TEST_CASE("the rows of a lever say for which d they are worst") {
  const Scene scene = demo("free-or-not", {"world.duration=1.0"});
  Recording recording = record(scene, 10.0);
  for (ContactSample& c : recording.samples[5].contacts) c.force *= 1.01;
  recording.samples[10].joints[0].force.y() += 1.0;
  const std::vector<ClaimRow> rows = findCheck("lever")->rows(scene, recording);
  const auto says = [&](const char* what, const char* where) {
    return std::any_of(rows.begin(), rows.end(), [&](const ClaimRow& row) {
      return row.label.find(what) != std::string::npos && row.label.ends_with(where);
    });
  };
  CHECK(says("force of the prop", ", worst at d = 0.4 m, t = 0.5 s"));
  CHECK(says("force of the hinge, m g", ", worst at d = 0.6 m, t = 1 s"));
  CHECK(says("what is left", ", worst at d = 0.6 m, t = 1 s"));
}

TEST_CASE("a wrong force of a prop, a hinge or a wall breaks a claim") {
  const Scene scene = demo("free-or-not", {"world.duration=1.0"});
  const Recording right = record(scene, 10.0);
  CHECK(holds("lever", scene, right));
  CHECK_FALSE(holdsBroken("lever", scene, right, [](Recording& r) {
    for (ContactSample& c : r.samples[3].contacts) c.force *= 1.0 + 1e-10;
  }));
  CHECK_FALSE(holdsBroken("lever", scene, right,
                          [](Recording& r) { r.samples[3].joints[0].force.y() *= -1.0; }));
  CHECK_FALSE(holdsBroken("lever", scene, right,
                          [](Recording& r) { r.samples[3].joints[0].force.x() += 1e-8; }));
  CHECK_FALSE(holdsBroken("groove", scene, right, [](Recording& r) {
    for (ContactSample& c : r.samples[3].contacts) c.force *= 1.0 + 1e-10;
  }));
}

// Oracle: the scene. Every joint and sample has its row, forces as in the sample.
TEST_CASE("joints are written as a row for each sample, and none without them") {
  const Scene scene = demo("free-or-not", {"world.duration=0.5"});
  const Recording recording = record(scene, 2.0);
  const std::string csv = jointsCsv(recording, scene);
  CHECK(csv.starts_with("t,joint,a,b,px,py,pz,fx,fy,fz,tx,ty,tz\n0,hinge,plank,post,0,0.77"));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 3);
}

// Oracle: by hand. A chain of three links of 1 kg hangs from the world: joint k holds up what is
// below it, (3 − k) m g, whichever of its ends is called a. Relative error allowed 1e-9, measured
// below 1e-10.
TEST_CASE("the arrows of a hanging chain all point the same way, whoever is a and who is b") {
  const Scene scene = parseScene(R"(
[world]
method = "course"
duration = 0.1
[[array]]
name = "link"
kind = "row"
count = 3
step = [0.0, -0.2, 0.0]
body = { shape = { sphere = 0.05 }, mass = 1.0, position = [0.0, -0.1, 0.0] }
[[joint]]
kind = "ball"
a = "link.0"
anchor = [0.0, 0.0, 0.0]
[[joint]]
kind = "ball"
a = "link.0"
b = "link.1"
anchor = [0.0, -0.2, 0.0]
[[joint]]
kind = "ball"
a = "link.2"
b = "link.1"
anchor = [0.0, -0.4, 0.0]
[show]
joint_forces = true
force_scale = 0.01
)",
                                 "chain.toml");
  const Recording recording = record(scene, 10.0);
  const Picture picture = Presenter(scene, recording).still(0.0);
  REQUIRE(picture.arrows.size() == 3);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d along = picture.arrows[k].tip - picture.arrows[k].base;
    CHECK(along.y() == Approx(0.01 * 9.81 * (3 - k)).epsilon(1e-9));
    CHECK(picture.arrows[k].colour[1] > picture.arrows[k].colour[0]);  // green: it holds up
  }
}

// Oracle: the sign. The arrow of a hinge that pulls down points down and is red.
TEST_CASE("the arrow of a hinge changes its colour with the sign of its force") {
  const Scene scene = demo("free-or-not");
  const Recording recording = record(scene, 2.0);
  const Presenter presenter(scene, recording);
  const auto arrowAt = [&](double t) {
    const Picture picture = presenter.still(t);
    const auto found = std::find_if(picture.arrows.begin(), picture.arrows.end(),
                                    [](const Arrow& a) { return a.base.x() < 1e-6; });
    REQUIRE(found != picture.arrows.end());
    return *found;
  };
  const Arrow pulls = arrowAt(0.5), holds = arrowAt(4.0);
  CHECK(pulls.tip.y() < pulls.base.y());
  CHECK(holds.tip.y() > holds.base.y());
  CHECK(pulls.colour[0] > pulls.colour[1]);
  CHECK(holds.colour[1] > holds.colour[0]);
}
