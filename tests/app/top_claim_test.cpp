// The claim of heavy tops accepts runs that are true and refuses each kind of untruth.
#include <functional>

#include "sim/math/rotation.h"
#include "tests/app/claims.h"

using namespace tumble;

namespace {

// An uneven top that leans, nods and precesses.
Scene topScene(const char* method) {
  BodyDef top;
  top.name = "top";
  top.shape = Box{{0.05, 0.1, 0.15}};
  top.density = 1000.0;
  top.orientation = fromAxisAngle({1.0, 2.0, -0.5}, 0.8);
  top.angularVelocity = top.orientation * Vec3(1.0, 2.0, 20.0);
  top.pivot_B = Vec3(0.02, 0.0, -0.2);
  Scene scene;
  scene.world.method = method;
  scene.world.duration = 3.0;
  scene.world.bodies = {top};
  return scene;
}

bool topHolds(const Scene& scene, const Recording& recording) {
  return tumble::holds("heavy-top", scene, recording);
}

}  // namespace

// Oracle: another method. Measured: exact against series 1.3e-11 rad, the rounding of the series'
// steps, and 5e-15 of what is kept; RK4 at 1/960 s 2.8e-8 rad and 6.4e-10.
TEST_CASE("tops by the exact method, by series and by fine steps keep the claim") {
  Scene scene = topScene("exact");
  CHECK(topHolds(scene, record(scene, 60.0)));
  scene.world.method = "course";
  scene.world.course.integrator = "taylor";
  CHECK(topHolds(scene, record(scene, 60.0)));
  scene.world.course.integrator = "rk4";
  scene.world.course.step = 1.0 / 960.0;
  CHECK(topHolds(scene, record(scene, 60.0)));
}

TEST_CASE("the claim of tops holds without gravity, sideways, and for a pendulum let go at rest") {
  Scene scene = topScene("exact");
  scene.world.gravity.setZero();
  CHECK(topHolds(scene, record(scene, 60.0)));
  scene.world.gravity = {3.0, -2.0, 7.0};
  CHECK(topHolds(scene, record(scene, 60.0)));
  scene.world.bodies[0].angularVelocity.setZero();
  CHECK(topHolds(scene, record(scene, 60.0)));
}

TEST_CASE("the claim of tops fails for coarse steps and for samples that lie") {
  Scene scene = topScene("course");
  scene.world.course.integrator = "euler";
  CHECK_FALSE(topHolds(scene, record(scene, 60.0)));

  scene.world.method = "exact";
  const Recording truth = record(scene, 60.0);
  const std::function<void(BodySample&)> lies[] = {
      [](BodySample& seen) {
        seen.q = rotated(seen.q, {0.0, 1e-8, 0.0});
      },
      [](BodySample& seen) { seen.omega *= 1.0 + 1e-10; },
      [](BodySample& seen) { seen.x.z() += 1e-10; },
  };
  for (const auto& lie : lies) {
    Recording told = truth;
    lie(told.samples[100].bodies[0]);
    CHECK_FALSE(topHolds(scene, told));
  }
}

TEST_CASE("the claim of tops says when there is none") {
  Scene scene = topScene("course");
  scene.world.bodies[0].pivot_B.reset();
  const std::vector<ClaimRow> rows = findCheck("heavy-top")->rows(scene, record(scene, 60.0));
  REQUIRE(rows.size() == 1);
  CHECK_FALSE(rows[0].holds());
  CHECK(rows[0].label == "no body turns about a held point under gravity alone");
}

// Tops that are far from round about their pivot take arcs as long as they move, and their turning
// does not depend on where they stand.
TEST_CASE("pendulums on thin strings, far levers and far places keep the claim of tops") {
  Scene scene = topScene("exact");
  BodyDef& bob = scene.world.bodies[0];
  bob.shape = Sphere{0.003};
  bob.angularVelocity.setZero();
  bob.pivot_B = Vec3(-1.0, 0.0, 0.0);
  CHECK(topHolds(scene, record(scene, 60.0)));
  scene = topScene("exact");
  scene.world.bodies[0].pivot_B = Vec3(-100.0, 0.0, 0.0);
  CHECK(topHolds(scene, record(scene, 60.0)));
  scene = topScene("exact");
  scene.world.bodies[0].position = {1e6, -3e5, 7.0};
  CHECK(topHolds(scene, record(scene, 60.0)));
}

// Joints of other bodies stay behind when a top is cut out of its scene; a top that a joint holds
// is none. Without either the cut world names a body that is not there, and is refused.
TEST_CASE("the claim of tops holds beside bodies with joints, and is none of a top with one") {
  Scene scene = topScene("course");
  for (const char* name : {"left", "right"}) {
    BodyDef other;
    other.name = name;
    other.shape = Sphere{0.1};
    other.density = 1000.0;
    other.position = {name[0] == 'l' ? 3.0 : 3.5, 0.0, 0.0};
    scene.world.bodies.push_back(other);
  }
  JointDef glue;
  glue.name = "glue";
  glue.kind = JointKind::Fixed;
  glue.a = 1;
  glue.b = 2;
  glue.anchorA = glue.anchorB = Vec3(3.2, 0.0, 0.0);
  scene.world.joints = {glue};
  scene.world.course.integrator = "rk4";
  scene.world.course.step = 1.0 / 960.0;
  CHECK(topHolds(scene, record(scene, 60.0)));

  glue.a = 0;
  scene.world.joints = {glue};
  const std::vector<ClaimRow> rows = findCheck("heavy-top")->rows(scene, Recording{});
  REQUIRE(rows.size() == 1);
  CHECK_FALSE(rows[0].holds());
}
