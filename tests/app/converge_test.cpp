// Halved steps: what they say of scenes whose orders are known.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <stdexcept>

#include "app/command/options.h"
#include "app/report/bounded.h"
#include "app/report/convergence.h"
#include "app/report/page.h"
#include "app/report/plot.h"
#include "app/scene/override.h"
#include "app/scene/scene.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A block that slides and does not stop before the end.
const std::string kBlock = R"(
[world]
duration = 0.4
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
friction = 0.5
[[body]]
name = "block"
shape = { box = [0.2, 0.1, 0.2] }
mass = 1.0
friction = 0.5
position = [0, 0.05, 0]
velocity = [2.5, 0, 0]
)";

// A ball between four walls and around a fixed ball: Sinai's billiard, in which each hit of the
// round one parts neighbours by a factor.
Scene billiard() {
  std::string text = "[world]\ngravity = [0, 0, 0]\nduration = 30.0\n";
  const char* const walls[] = {"1, 0, 0, -1", "-1, 0, 0, -1", "0, 0, 1, -1", "0, 0, -1, -1"};
  for (const char* wall : walls)
    text += "[[body]]\nrestitution = 1.0\nshape = { plane = [" + std::string(wall) + "] }\n";
  text += "[[body]]\nfixed = true\nrestitution = 1.0\nshape = { sphere = 0.4 }\n";
  text += "[[body]]\nmass = 1.0\nrestitution = 1.0\nshape = { sphere = 0.1 }\n";
  text += "position = [-0.7, 0, 0.1]\nvelocity = [1.5, 0, 0.37]\n";
  return parseScene(text, "billiard.toml");
}

Convergence converged(const Scene& scene, const std::vector<double>& instants) {
  const HalvingPlan plan{instants, 20.0};
  return convergenceOf(scene, plan, runHalved(scene, plan));
}

const MethodAt& of(const Convergence& convergence, const std::string& method,
                   std::size_t instant = 0) {
  const auto& names = convergence.methods;
  const auto found = std::find(names.begin(), names.end(), method);
  REQUIRE(found != names.end());
  return convergence.instants.at(instant).methods.at(
      static_cast<std::size_t>(found - names.begin()));
}

}  // namespace

// Oracle: closed form, y(h) = c hᵖ.
TEST_CASE("Richardson's estimate is right where a power of the step is all there is") {
  for (const double p : {1.0, 2.0, 4.0}) {
    std::vector<double> y, differences;
    for (int k = 0; k < 4; ++k) y.push_back(3.0 * std::pow(0.5, p * k));
    for (int k = 0; k < 3; ++k) differences.push_back(y[k] - y[k + 1]);
    const Richardson found = extrapolate(differences, 1e-15);
    CHECK(found.halving == Halving::Converges);
    CHECK(found.order == Approx(p).epsilon(1e-12));
    for (int k = 0; k < 4; ++k) CHECK(found.errors[k] == Approx(y[k]).epsilon(1e-12));
  }
}

TEST_CASE("what does not shrink does not converge, and what is rounding has no order") {
  CHECK(extrapolate(std::vector{1.0, 1.2, 0.9}, 1e-15).halving == Halving::Diverges);
  CHECK(extrapolate(std::vector{1.0, 1.2, 0.9}, 1e-15).errors.back() == kInfinity);
  const Richardson rounding = extrapolate(std::vector{3e-15, 8e-15, 2e-16}, 1e-15);
  CHECK(rounding.halving == Halving::Rounding);
  CHECK(rounding.errors == std::vector{3e-15, 8e-15, 1e-15, 1e-15});
  CHECK(extrapolate(std::vector{0.5}, 1e-15).halving == Halving::Unknown);
  CHECK(extrapolate(std::vector<double>{}, 1e-15).halving == Halving::Unknown);
  // Order 4 down into the rounding: the last difference says nothing.
  const Richardson steep = extrapolate(std::vector{1e-9, 0.625e-10, 1e-14}, 2e-15);
  CHECK(steep.halving == Halving::Converges);
  CHECK(steep.order == Approx(4.0));
  CHECK(steep.errors.back() == 2e-15);
}

// Oracle: closed form. Euler's method makes the way of a sliding block ½ a h t too long: order 1,
// and Richardson's error is that.
TEST_CASE("a block that slides is followed by Euler with order 1 in the step, else exactly") {
  const Scene scene = parseScene(kBlock, "block.toml", {"course.integrator=euler"});
  const Convergence found = converged(scene, {0.4});
  const MethodAt& euler = of(found, "course");
  CHECK(euler.richardson.halving == Halving::Converges);
  CHECK(euler.richardson.order == Approx(1.0).margin(0.01));
  CHECK_FALSE(euler.elsewhere);
  REQUIRE(euler.richardson.errors.size() == 4);
  const double exact = 0.5 * 0.5 * 9.81 * 0.4 * scene.world.course.step;
  CHECK(euler.richardson.errors[0] == Approx(exact).epsilon(0.01));
  CHECK(euler.offReference[0] == Approx(exact).epsilon(0.01));
  CHECK(of(found, "stepping").richardson.halving == Halving::Rounding);
  CHECK(found.methods[static_cast<std::size_t>(found.instants[0].reference)] == "exact");
  CHECK(wordFor(of(found, "exact")) == "no step");
  CHECK(of(found, "exact").offReference[0] == 0.0);
}

// Oracle: the order of each integrator. A body that tumbles freely.
TEST_CASE("the course follows a free body with the order of its integrator") {
  const std::string text = R"(
[world]
gravity = [0, 0, 0]
duration = 1.0
[course]
step = 0.02
[[body]]
shape = { box = [0.1, 0.2, 0.3] }
mass = 1.0
angular_velocity = [3, 2, 1]
)";
  for (const auto& [integrator, order] :
       {std::pair("euler", 1.0), std::pair("midpoint", 2.0), std::pair("rk4", 4.0)}) {
    CAPTURE(integrator);
    const Convergence found = converged(
        parseScene(text, "free.toml", {"course.integrator=" + std::string(integrator)}), {1.0});
    const MethodAt& course = of(found, "course");
    CHECK(course.richardson.halving == Halving::Converges);
    CHECK(course.richardson.order == Approx(order).margin(0.2));
    CHECK_FALSE(course.elsewhere);
    // Against the closed form.
    CHECK(course.richardson.errors.back() == Approx(course.offReference.back()).epsilon(0.2));
  }
}

// Oracle: chaos. Before it hits the round one, a ball of the billiard is where it should be by
// every method; after some thirty hits of it nothing is left of any start.
TEST_CASE("a billiard converges before its first hits, and not after thirty") {
  const Convergence found = converged(billiard(), {0.1, 30.0});
  for (const char* method : {"course", "stepping"}) {
    CAPTURE(method, wordFor(of(found, method, 1)));
    CHECK(of(found, method, 0).richardson.halving == Halving::Rounding);
    const Halving late = of(found, method, 1).richardson.halving;
    CHECK((late == Halving::Chaos || late == Halving::Diverges));
    CHECK(of(found, method, 1).richardson.errors.back() == kInfinity);
    CHECK(wordFor(of(found, method, 1)).starts_with("does not converge"));
  }
  CHECK(of(found, "exact", 1).noise > 1e-3);
}

// Springs in place of impacts converge with the step, to a motion that is not that of impacts.
TEST_CASE("a method that converges to another motion is told") {
  const std::string text = R"(
[world]
duration = 1.0
[course]
contact = "penalty"
stiffness = 2000.0
step = 0.001
[[body]]
shape = { plane = [0, 1, 0, 0] }
restitution = 1.0
[[body]]
shape = { sphere = 0.1 }
mass = 1.0
restitution = 1.0
position = [0, 0.6, 0]
)";
  const Convergence found = converged(parseScene(text, "springs.toml"), {1.0});
  CHECK(of(found, "course").richardson.halving == Halving::Converges);
  CHECK(of(found, "course").elsewhere);
  CHECK_FALSE(of(found, "stepping").elsewhere);
  CHECK(convergenceText(found).find("far beyond the errors of both") != std::string::npos);
}

// Oracle: closed form, x = 0.1 cos(10 t) about the rest. `exact` takes no springs.
TEST_CASE(
    "a method that refuses the scene is told with its reason, and the best other one serves") {
  const std::string text = R"(
[world]
gravity = [0, 0, 0]
duration = 1.0
[course]
step = 0.01
[[body]]
name = "bob"
shape = "particle"
mass = 1.0
position = [1.1, 0, 0]
[[force]]
kind = "spring"
a = "bob"
stiffness = 100.0
rest = 1.0
)";
  const Convergence found = converged(parseScene(text, "spring.toml"), {0.5, 1.0});
  CHECK(of(found, "exact").steps.empty());
  CHECK(of(found, "exact").missing.starts_with("refuses the scene: "));
  CHECK(wordFor(of(found, "exact")) == "no run");
  CHECK(of(found, "course").richardson.order == Approx(4.0).margin(0.2));
  // Of the others the one with the least error, by its own account, is the reference.
  REQUIRE(found.instants[1].reference >= 0);
  const MethodAt& best =
      found.instants[1].methods[static_cast<std::size_t>(found.instants[1].reference)];
  for (const char* method : {"course", "stepping"})
    CHECK(best.richardson.errors.back() <= of(found, method, 1).richardson.errors.back());
  CHECK(best.offReference.back() == 0.0);
}

TEST_CASE("the tables have a row for each run, and the figure a curve for each method") {
  const Scene scene = parseScene(kBlock, "block.toml", {"course.integrator=euler"});
  const Convergence found = converged(scene, {0.2, 0.4});
  const std::string csv = convergenceCsv(found);
  CHECK(csv.starts_with(
      "t,method,step,difference,order,error,off_reference,noise,cpu_seconds,says\n"));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 1 + 2 * (4 + 1 + 4));
  const Study study = speedOf(found);
  CHECK(drawable(study));
  REQUIRE(study.series.size() == 3);
  CHECK(study.notes == std::vector<std::string>{"order 1.0", "no step", "rounding"});
  CHECK(study.series[2].label == "stepping");
  CHECK(study.series[2].points.size() == 4);
  CHECK(plotScript(study, labelsOf(std::span(&study, 1)), "").find("'course  (order 1.0)'") !=
        std::string::npos);
  CHECK_FALSE(drawable(Study{}));
}

TEST_CASE("work beyond its time is ended, and what it had sent is kept") {
  const Bounded whole = runBounded(5.0, [](const Send& send) { send("all"); });
  CHECK((whole.whole && !whole.outOfTime && whole.sent == "all"));
  const Bounded endless = runBounded(0.2, [](const Send& send) {
    send("so far");
    while (std::clock() >= 0) {
    }
  });
  CHECK((!endless.whole && endless.outOfTime && endless.sent == "so far"));
  const Bounded broken = runBounded(5.0, [](const Send&) { throw std::runtime_error("no"); });
  CHECK((!broken.whole && !broken.outOfTime));
}

TEST_CASE("instants are read in ascending order within the duration") {
  CHECK(parseInstants("0.5,2", 2.0) == std::vector{0.5, 2.0});
  for (const char* wrong : {"", "0", "-1", "1,", ",1", "1,1", "2,1", "3", "1;2", "nan", "a"})
    CHECK_THROWS_AS(parseInstants(wrong, 2.0), UsageError);
}
