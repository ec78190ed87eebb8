// The claims of the course's plans and of penalty contacts hold for true runs, under every setting
// that they read, and fail for untrue ones; the panels of their demos keep them too.
#include <cmath>

#include "app/claim/verdict.h"
#include "app/panel/page.h"
#include "app/present/present.h"
#include "tests/app/claims.h"
#include "tests/app/runs.h"

using namespace tumble;

namespace {

bool keeps(const std::string& name, const std::vector<std::string>& overrides) {
  const Scene scene = demo(name, overrides);
  CAPTURE(scene.line);
  return holds(scene.checks[0].c_str(), scene, record(scene, scene.image.rate));
}

}  // namespace

// Oracles: the closed forms of app/claim/plans.cpp.
TEST_CASE("every plan keeps its claims whatever the fall") {
  for (const char* plan : {"backstep", "gradual", "lie"}) {
    CAPTURE(plan);
    const std::string set = std::string("course.plan=") + plan;
    CHECK(keeps("three-plans", {set}));
    CHECK(keeps("three-plans", {set, "world.gravity=[0.5, -3.0, 1.0]", "world.duration=4.0"}));
    CHECK(keeps("three-plans", {set, "materials.rubber.restitution=0.65", "world.duration=5.0"}));
    CHECK(keeps("three-plans", {set, "materials.rubber.restitution=0.0", "world.duration=2.0"}));
    CHECK(keeps("three-plans", {set, "course.step=0.037", "course.repair_steps=9"}));
    CHECK(keeps("three-plans", {set, "body.ball.shape={ box = [0.2, 0.3, 0.4] }"}));
    CHECK(keeps("three-plans", {set, "body.ball.velocity=[0.0, 1.5, 0.0]", "body.ball.mass=7.0"}));
    CHECK(keeps("three-plans",
                {set, "body.floor.shape={ plane = [0.3, 1.0, 0.1, -0.4] }", "world.duration=1.5"}));
  }
}

// Oracles: the closed forms of app/claim/spring_contact.cpp.
TEST_CASE("springs keep their claims whatever the ball and the floor") {
  for (const char* contact : {"penalty", "constraint"}) {
    CAPTURE(contact);
    const std::string set = std::string("course.contact=") + contact;
    CHECK(keeps("soft-to-hard", {set}));
    CHECK(keeps("soft-to-hard", {set, "course.stiffness=3e4", "body.ball.mass=0.3"}));
    CHECK(keeps("soft-to-hard", {set, "world.gravity=[1.0, -9.81, 2.0]"}));
    CHECK(keeps("soft-to-hard", {set, "world.gravity=[0.0, 2.0, 0.0]"}));
    CHECK(keeps("soft-to-hard", {set, "body.ball.shape={ sphere = 0.05 }"}));
    CHECK(keeps("soft-to-hard", {set, "body.ball.velocity=[0.0, -5.0, 1.0]"}));
    CHECK(keeps("soft-to-hard", {set, "course.damping=3.0"}));
    CHECK(keeps("soft-to-hard",
                {set, "body.floor.shape={ plane = [0.3, 1.0, 0.1, -0.4] }", "world.duration=1.5"}));
  }
}

TEST_CASE("every panel of the two demos keeps the claims of its scene") {
  for (const char* name : {"three-plans", "soft-to-hard"}) {
    const Scene scene = demo(name);
    REQUIRE(scene.panels.size() >= 3);
    for (const PanelDef& panel : scene.panels) {
      CAPTURE(name, panel.variant.title);
      const Scene variant = sceneOf(scene, panel.variant);
      CHECK(holds(variant.checks[0].c_str(), variant, record(variant, variant.image.rate)));
    }
  }
}

TEST_CASE("an untrue plan breaks its claims") {
  const auto move = [](Recording& r) {
    for (Sample& sample : r.samples)
      if (sample.t > 0.5) sample.bodies[1].x.y() += 1e-4;
  };
  for (const char* plan : {"backstep", "gradual", "lie"}) {
    CAPTURE(plan);
    const Scene scene = demo("three-plans", {std::string("course.plan=") + plan});
    const Recording recording = record(scene, scene.image.rate);
    CHECK_FALSE(holdsBroken("plans", scene, recording, move));
    CHECK_FALSE(holdsBroken("plans", scene, recording, [](Recording& r) {
      r.report.certificate.energy_added_repair += 1e-3;
    }));
    if (std::string_view(plan) == "backstep") {
      CHECK_FALSE(holdsBroken("plans", scene, recording,
                              [](Recording& r) { r.report.events[0].t += 2e-10; }));
    } else {
      CHECK_FALSE(holdsBroken("plans", scene, recording,
                              [](Recording& r) { r.report.missteps[0].separation *= 1.001; }));
    }
    CHECK_FALSE(holds("plans", demo("soft-to-hard"), recording));  // nothing that it could hold
  }
}

TEST_CASE("an untrue spring breaks its claims") {
  const Scene scene = demo("soft-to-hard");
  const Recording recording = record(scene, scene.image.rate);
  const auto broken = [&](const std::function<void(Recording&)>& breakIt) {
    return holdsBroken("spring-contact", scene, recording, breakIt);
  };
  CHECK_FALSE(broken([](Recording& r) { r.report.events[0].t += 1e-5; }));
  CHECK_FALSE(broken([](Recording& r) { r.report.events[1].t += 1e-5; }));
  CHECK_FALSE(broken([](Recording& r) { r.report.events[1].vrel *= 1.00001; }));
  CHECK_FALSE(broken([](Recording& r) { r.report.events.clear(); }));
  CHECK_FALSE(broken([](Recording& r) {
    for (Sample& sample : r.samples)
      for (ContactSample& contact : sample.contacts) contact.force *= 1.00001;
  }));
  CHECK_FALSE(broken([](Recording& r) {
    for (Sample& sample : r.samples)
      for (ContactSample& contact : sample.contacts) contact.separation *= 1.00001;
  }));
  CHECK_FALSE(holds("spring-contact", demo("stacked-boxes"), recording));
}

// Oracle: the misstep itself. The red ghost stands where the step led, the other where the plan put
// the body, and an arrow goes from one to the other.
TEST_CASE("a picture shows where a plan was led to and where it put the body") {
  for (const char* plan : {"backstep", "gradual", "lie"}) {
    CAPTURE(plan);
    const Scene scene = demo("three-plans", {std::string("course.plan=") + plan});
    const Recording recording = record(scene, scene.image.rate);
    REQUIRE_FALSE(recording.report.missteps.empty());
    const Misstep& misstep = recording.report.missteps[0];
    const Picture picture = Presenter(scene, recording).strobe();
    REQUIRE(picture.arrows.size() == 1);
    const Arrow& arrow = picture.arrows[0];
    CHECK(((arrow.tip - arrow.base) - (misstep.mended.x - misstep.pose.x)).norm() < 1e-12);
    int red = 0;
    for (const Instance& instance : picture.instances)
      if (instance.position == misstep.pose.x && instance.colour[0] > 0.8f &&
          instance.colour[1] < 0.3f)
        ++red;
    CHECK(red == 1);
    // A ghost of the run in the same place does not hide it, by a higher layer or a larger ball.
    for (const Instance& ghost : picture.instances)
      for (const Instance& one : picture.instances)
        if (ghost.finish == Finish::Ghost && one.position == ghost.position &&
            one.scale.x() > ghost.scale.x())
          CHECK(one.layer >= ghost.layer);
    // Before the misstep there is nothing to show.
    CHECK(Presenter(scene, recording).still(0.1).arrows.empty());
  }
}

// Oracle: closed form, v t and its height; a curve is the run that its settings say.
TEST_CASE("a graph shows what a body does in each of its variants") {
  const Scene scene = demo("soft-to-hard", {"image.rate=100.0"});
  REQUIRE(scene.graphs.size() == 2);
  GraphDef graph = scene.graphs[0];
  graph.variant.set.clear();
  const std::vector<GraphSeries> series = runGraph(scene, graph, [] {});
  REQUIRE(series.size() == 5);
  CHECK(series[0].label == "100 N/m");
  REQUIRE(series[0].points.size() == 61);
  // Force k d with d = (v/ω) sin ω(t − 0.15), at 0.3 s; measured 2e-14, allowed 1e-9.
  CHECK(series[0].points[30].y() == Approx(20.0 * std::sin(10.0 * 0.15)).epsilon(1e-9));
  CHECK(series[0].impacts.empty());
  REQUIRE(series[4].impacts.size() == 1);
  const Chart chart = graphOf(graph, series);
  REQUIRE(chart.guides.size() == 1);
  CHECK(chart.guides[0].at == Approx(0.15).epsilon(1e-9));
  CHECK_FALSE(chart.x.logarithmic);

  const Sample sample = record(scene, 100.0).samples[5];
  CHECK(shownOf("height", sample, 1) == Approx(0.6 - 2.0 * 0.05).epsilon(1e-12));
  CHECK(shownOf("velocity", sample, 1) == Approx(-2.0).epsilon(1e-12));
  CHECK(shownOf("force", sample, 1) == 0.0);
  CHECK(shownOf("energy", sample, 1) == Approx(0.5 * (16.0 + 4.0)).epsilon(1e-12));
  CHECK(graphCsv(series, 20).starts_with("curve,t,value\n\"100 N/m\",0,"));
}

TEST_CASE("a graph that names no body or nothing to show is refused") {
  const auto complaint = [](const std::string& graph) -> std::string {
    try {
      parseScene("[world]\n[[body]]\nname = \"floor\"\nshape = { plane = [0, 1, 0, 0] }\n" + graph,
                 "s.toml");
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(complaint("[[graph]]\nbody = \"floor\"\ncurves = [{ label = \"a\" }]\n").empty());
  CHECK(complaint("[[graph]]\nshows = \"energy\"\ncurves = [{ label = \"a\" }]\n").empty());
  CHECK(complaint("[[graph]]\nshows = \"height\"\ncurves = [{ label = \"a\" }]\n")
            .find("graph.0.body: missing; expected the name") != std::string::npos);
  CHECK(complaint("[[graph]]\nbody = \"flor\"\ncurves = [{ label = \"a\" }]\n")
            .find("graph.0.body: expected the name of a body, found") != std::string::npos);
  CHECK(complaint("[[graph]]\nbody = \"floor\"\nshows = \"mood\"\ncurves = [{ label = \"a\" }]\n")
            .find("unknown value 'mood'") != std::string::npos);
  CHECK(complaint("[[graph]]\nbody = \"floor\"\n").find("expected 1 to 100 tables") !=
        std::string::npos);
}
