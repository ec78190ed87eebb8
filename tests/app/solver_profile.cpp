// The profile of solvers: its steps, and the problems that scenes pose.
#include "app/report/profile.h"

#include <cmath>
#include <limits>

#include "app/report/plot.h"
#include "app/scene/demos.h"
#include "app/scene/scene.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

using Steps = std::vector<std::pair<double, double>>;

}  // namespace

// Oracle: worked out by hand. The second solver is the fastest of one problem, fails on one, and
// takes three and twice the time on the others.
TEST_CASE("a profile says how often a solver is within a factor of the fastest") {
  const Profile profile{"known",
                        "Known",
                        "four problems",
                        {{"one", {1.0, 2.0, 4.0, 1.0}}, {"two", {3.0, 1.0, 8.0, kNever}}}};
  CHECK(profileSteps(profile, 0) == Steps{{1.0, 0.75}, {2.0, 1.0}, {3.0, 1.0}});
  CHECK(profileSteps(profile, 1) == Steps{{1.0, 0.25}, {2.0, 0.5}, {3.0, 0.75}});
  CHECK(profileCsv(profile) ==
        "solver,ratio,share\none,1,0.75\none,2,1\none,3,1\ntwo,1,0.25\ntwo,2,0.5\ntwo,3,0.75\n");
  const std::string script = plotScript(profile, "this machine");
  CHECK(script.find("every ::0::2 using 2:3 with steps") != std::string::npos);
  CHECK(script.find("every ::3::5 using 2:3 with steps") != std::string::npos);
  CHECK(script.find("'two  (75 %)'") != std::string::npos);
}

TEST_CASE("a solver that solves nothing has a curve along the bottom") {
  const Profile profile{"none", "None", "", {{"one", {1.0, 1.0}}, {"two", {kNever, kNever}}}};
  CHECK(profileSteps(profile, 0) == Steps{{1.0, 1.0}});
  CHECK(profileSteps(profile, 1) == Steps{{1.0, 0.0}});
}

// Oracle: Newton's law. What rests takes h g from each body; nothing moves afterwards.
TEST_CASE("the problems of stacked boxes are those of boxes at rest, and all solvers solve them") {
  constexpr double kStep = 1.0 / 240.0;  // s
  Scene scene = readScene(scenePath("stacked-boxes"));
  scene.world.duration = 0.1;
  const std::vector<Problem> problems = contactProblems(scene, 4, kStep);
  REQUIRE(problems.size() == 4);
  const Problem& last = problems.back();
  CHECK(last.cones.size() >= 4);
  for (std::size_t body = 0; body < last.invM.size(); ++body)
    if (last.invM[body] > 0.0)
      CHECK(last.vStar[body][1] == Approx(scene.world.gravity.y() * kStep).epsilon(1e-3));
  const Profile profile = solverProfile(problems, 1e-8);
  REQUIRE(profile.curves.size() == solvers().size());
  for (const ProfileCurve& curve : profile.curves) {
    CAPTURE(curve.label);
    for (double seconds : curve.seconds) CHECK(std::isfinite(seconds));
  }
}

TEST_CASE("every demo can be asked for its contact problems, particles and all") {
  for (const std::string& name : demoNames()) {
    CAPTURE(name);
    Scene scene = readScene(scenePath(name));
    scene.world.duration = 0.01;
    CHECK_NOTHROW(contactProblems(scene, 2, 1.0 / 240.0));
  }
}

// Oracle: worked out by hand. By "exact" 1e-3 at 1 µs; by "stepping" 1e-1 at 1 µs and 1e-2 at 4 µs.
// So 1e-1 is stepping's and exact's at 1 µs both, 1e-2 is exact's by a factor of 4, 1e-3 is exact's
// alone, and no run comes further. The second study has one method alone.
TEST_CASE(
    "the profile of methods asks for accuracies that some run comes to, where methods compete") {
  Study study;
  study.series.resize(2);
  study.methods = {"exact", "stepping"};
  study.series[0].points = {{"x", 1e-3, 0, 1e-6}};
  study.series[1].points = {{"x", 1e-1, 0, 1e-6}, {"x", 1e-2, 0, 4e-6}};
  Study alone = study;
  alone.methods = {"course", "course"};
  const Profile profile = methodProfile(std::vector{study, alone});
  REQUIRE(profile.curves.size() == 2);
  CHECK(profile.curves[0].label == "exact");
  CHECK(profile.curves[1].label == "stepping");
  CHECK(profile.curves[0].seconds == std::vector{1e-6, 1e-6, 1e-6});
  CHECK(profile.curves[1].seconds == std::vector{1e-6, 4e-6, kNever});
  CHECK(profileSteps(profile, 1) == Steps{{1.0, 1.0 / 3.0}, {4.0, 2.0 / 3.0}});
}
