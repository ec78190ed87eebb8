// Particles and circular fields from the scene to the trajectory.
#include <string>

#include "app/claim/claim.h"
#include "app/record/output.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

const std::string kRing = R"(
[world]
gravity = [0, 0, 0]
duration = 6.283185307179586
method = "course"
[course]
step = 0.01
[[array]]
name = "dot"
kind = "row"
count = 3
step = [0.5, 0, 0]
body = { shape = "particle", mass = 0.2, position = [1, 2, 0] }
vary = { velocity = [[0, 1, 0], [0, 2, 0]] }
[[body]]
name = "other"
shape = { sphere = 0.1 }
mass = 1.0
position = [1, 2, 0]
[[force]]
kind = "field"
body = "dot"
centre = [0, 2, 0]
axis = [0, 0, 2]
rate = 1.0
)";

std::vector<ClaimRow> orbitRows(const std::string& text, const std::vector<std::string>& set = {}) {
  const Scene scene = parseScene(text, "ring.toml", set);
  return findCheck("orbit")->rows(scene, record(scene, 60.0));
}

}  // namespace

TEST_CASE("a force that names an array acts on each of its copies and on nobody else") {
  const Scene scene = parseScene(kRing, "ring.toml");
  REQUIRE(scene.world.forces.size() == 3);
  for (int i = 0; i < 3; ++i) {
    const CircularField& field = std::get<CircularField>(scene.world.forces[i]);
    CHECK(scene.world.bodies[field.body].name == "dot." + std::to_string(i));
    CHECK(field.centre == Vec3(0.0, 2.0, 0.0));
    CHECK(field.rotation == Vec3(0.0, 0.0, 1.0));
  }
  CHECK_NOTHROW(parseScene(kRing, "s.toml", {"force.0.body=\"dot.1\""}));
  CHECK_NOTHROW(parseScene(kRing, "s.toml", {"force.0.body=\"other\""}));
}

TEST_CASE("a particle passes through everything and writes an orientation that stays") {
  const Scene scene = parseScene(kRing, "ring.toml");
  const Recording recording = record(scene, 10.0);
  CHECK(recording.report.events.empty());
  const std::string csv = trajectoryCsv(recording, scene);
  const std::size_t row = csv.find("dot.0");
  REQUIRE(row != std::string::npos);
  CHECK(csv.substr(row, csv.find('\n', row) - row) == "dot.0,1,2,0,1,0,0,0,0,1,0,0,0,0");
  for (const Sample& sample : recording.samples)
    for (int i = 1; i < 4; ++i) {
      REQUIRE(sample.bodies[i].q.coeffs() == Quat::Identity().coeffs());
      REQUIRE(sample.bodies[i].omega.isZero(0.0));
    }
}

// Oracle: closed form. RK4 at h = 10 ms: phase lost in a turn h⁴ Ω⁵ t/120 = 5.2e-10, radius
// h⁵ Ω⁶ t/144 = 4.4e-12; measured 5.2e-10 and 4.3e-12, allowed 1e-9.
TEST_CASE("orbits hold to the exact radius and phase, and fail for a coarse solver") {
  for (const ClaimRow& row : orbitRows(kRing)) {
    INFO(row.label << ": " << row.error);
    CHECK(row.holds());
    CHECK(row.error > 0.0);
  }
  for (const ClaimRow& row : orbitRows(kRing, {"course.integrator=euler"})) CHECK(!row.holds());
  // The wrong rate by one part in a million is seen.
  const Scene scene = parseScene(kRing, "ring.toml");
  const Scene faster = parseScene(kRing, "ring.toml", {"force.0.rate=1.000001"});
  const std::vector<ClaimRow> rows = findCheck("orbit")->rows(faster, record(scene, 60.0));
  CHECK(!rows[1].holds());
}

// Oracle: closed form, gravity across and along the axis. Measured 3.9e-11, allowed 1e-9.
TEST_CASE("an orbit under gravity turns about the point where field and gravity balance") {
  for (const char* gravity : {"world.gravity=[0,-9.81,0]", "world.gravity=[1,-2,3]"})
    for (const ClaimRow& row : orbitRows(kRing, {gravity, "course.step=0.005"})) CHECK(row.holds());
}

TEST_CASE("without a circular field the claim fails") {
  const std::vector<ClaimRow> rows =
      orbitRows("[world]\n[[body]]\nshape = { sphere = 1 }\nmass = 1\n");
  REQUIRE(rows.size() == 1);
  CHECK(!rows[0].holds());
}
