// Planes between bodies that pass: what is drawn, what is claimed, and what searching costs.
#include <algorithm>

#include "app/claim/parting.h"
#include "app/claim/verdict.h"
#include "app/panel/graph_run.h"
#include "app/present/planes.h"
#include "app/present/present.h"
#include "app/report/plot.h"
#include "tests/app/claims.h"
#include "tests/app/runs.h"

using namespace tumble;

namespace {

// The discs that are drawn at a sample.
std::vector<Instance> discsAt(const Scene& scene, const Recording& recording, double t) {
  Picture picture;
  addPlanes(scene, recording, static_cast<int>(t * recording.rate + 0.5), picture);
  return picture.instances;
}

bool greener(const Instance& disc) {
  return disc.colour[1] > disc.colour[0];
}

}  // namespace

TEST_CASE(
    "the claim of planes holds for other passes, and fails where bodies were moved together") {
  const Scene scene = demo("between-us");
  const Recording recording = record(scene, scene.image.rate);
  CHECK(holds("apart", scene, recording));
  const auto lift = [](const char* what, double by) {
    const std::size_t body = what[0] == 'h' ? 0 : 2;  // hull_a, ell_a
    return [=](Recording& broken) {
      for (Sample& sample : broken.samples) sample.bodies[body].x.y() += by;
    };
  };
  CHECK(holdsBroken("apart", scene, recording, lift("hull", 0.1)));
  CHECK_FALSE(holdsBroken("apart", scene, recording, lift("hull", -0.1)));
  CHECK(holdsBroken("apart", scene, recording, lift("ell", -0.1)));
  CHECK_FALSE(holdsBroken("apart", scene, recording, lift("ell", 0.1)));

  const Scene slow = demo(
      "between-us", {"body.hull_a.angular_velocity=[0.0, 0.0, 0.0]", "world.method=\"course\""});
  CHECK(holds("apart", slow, record(slow, 40.0)));
}

// Oracle: brute force over the corners.
TEST_CASE("a disc between two solids has the corners of each on its own side") {
  const Scene scene = demo("between-us");
  const Recording recording = record(scene, scene.image.rate);
  Coherence coherence(scene);
  int seen = 0;
  for (const Sample& sample : recording.samples) {
    for (const Parting& p : coherence.look(sample)) {
      REQUIRE(p.b.body < p.a.body);
      REQUIRE(p.gap > 0.0);
      const std::vector<Vec3> a = cornersOf(p.a.solid, p.a.pose);
      const std::vector<Vec3> b = cornersOf(p.b.solid, p.b.pose);
      REQUIRE(a.size() >= 8);
      double low = 1e9, top = -1e9;
      for (const Vec3& corner : a) low = std::min(low, p.n.dot(corner));
      for (const Vec3& corner : b) top = std::max(top, p.n.dot(corner));
      REQUIRE(low - top > p.gap - 1e-12);
      ++seen;
    }
    // Of the two hulls, where it is drawn.
    const double t = sample.t;
    if (t < 1.9 || t > 2.1) continue;
    const std::vector<Instance> discs = discsAt(scene, recording, t);
    REQUIRE(!discs.empty());
    const std::vector<PlacedPart> parts = placedParts(scene, sample);
    const Vec3 n = discs[0].orientation * Vec3::UnitY();
    for (const Vec3& corner : cornersOf(parts[0].solid, parts[0].pose))
      REQUIRE(n.dot(corner - discs[0].position) < 0.0);
    for (const Vec3& corner : cornersOf(parts[1].solid, parts[1].pose))
      REQUIRE(n.dot(corner - discs[0].position) > 0.0);
  }
  CHECK(coherence.pairs() == seen);
  CHECK(coherence.searches() < seen / 10);
}

TEST_CASE("a disc is green if remembered, orange if sought, and dark where bodies touch") {
  const Scene scene = demo("between-us");
  const Recording recording = record(scene, scene.image.rate);
  Coherence coherence(scene);
  int green = 0, orange = 0;
  for (const Sample& sample : recording.samples) {
    const std::vector<Parting> now = coherence.look(sample);
    if (sample.t < 1.5 || sample.t > 2.5) continue;
    const auto hulls = std::find_if(
        now.begin(), now.end(), [](const Parting& p) { return p.b.body == 0 && p.a.body == 1; });
    REQUIRE(hulls != now.end());
    const std::vector<Instance> discs = discsAt(scene, recording, sample.t);
    if (hulls->gap > 0.2) continue;  // too far apart to be drawn
    CHECK(greener(discs.at(0)) == hulls->remembered);
    ++(hulls->remembered ? green : orange);
  }
  CHECK(green > 20);
  CHECK(orange > 1);

  const Variant touching = demo("between-us").panels.back().variant;  // a face on a face
  const Scene stack = readScene(demo("between-us").file, {}, &touching);
  const std::vector<Instance> discs = discsAt(stack, record(stack, 60.0), 0.0);
  REQUIRE(discs.size() == 1);
  CHECK(*std::max_element(discs[0].colour.begin(), discs[0].colour.end()) < 0.3f);
  CHECK(std::abs((discs[0].orientation * Vec3::UnitY()).y()) > 1.0 - 1e-12);
  CHECK(discs[0].position.norm() < 1e-9);
}

TEST_CASE("the six panels of contacts touch, and an L as a hull is hit while its boxes pass") {
  int touching = 0;
  for (const PanelDef& panel : demo("between-us").panels) {
    CAPTURE(panel.variant.title);
    const Scene scene = readScene(demo("between-us").file, {}, &panel.variant);
    const Recording recording = record(scene, scene.image.rate);
    REQUIRE_FALSE(recording.report.stopped);
    if (scene.world.duration < 1.0 && !recording.samples[0].contacts.empty()) ++touching;
    const bool wrapped = panel.variant.title.find("hulls") != std::string::npos;
    if (scene.world.duration > 1.0) CHECK(recording.report.events.empty() != wrapped);
  }
  CHECK(touching == 6);
}

TEST_CASE("remembered planes are sought less often, and the graph of it never falls") {
  const Scene scene = demo("between-us");
  const std::vector<GraphSeries> series = runGraph(scene, scene.graphs[0], [] {});
  REQUIRE(series.size() == 2);
  for (const GraphSeries& one : series)
    for (std::size_t k = 1; k < one.points.size(); ++k)
      REQUIRE(one.points[k].y() >= one.points[k - 1].y());
  CHECK(10.0 * series[0].points.back().y() < series[1].points.back().y());
}

TEST_CASE("the figure of a scaling draws each curve from the numbers beside it, with its slope") {
  const Scaling scaling{
      "known", "Known", "of",
      "n",     "s",     {{"one", {{10, 1e-6}, {100, 1e-4}}, 2.0}, {"two", {{10, 3e-6}}, 1.0}}};
  CHECK(scalingCsv(scaling) ==
        "curve,size,cpu_seconds\n\"one\",10,1e-06\n\"one\",100,0.0001\n\"two\",10,3e-06\n");
  const std::string script = plotScript(scaling, "this machine");
  CHECK(script.find("plot './known.csv' skip 1 every ::0::1 using 2:3 ") != std::string::npos);
  CHECK(script.find(" './known.csv' skip 1 every ::2::2 using 2:3 ") != std::string::npos);
  CHECK(script.find("title 'one  (slope 2.00)'") != std::string::npos);
  CHECK(script.find("set ylabel 's'") != std::string::npos);
}
