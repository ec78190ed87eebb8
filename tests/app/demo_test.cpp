// Every demo keeps its claims, as it is and with its parameters changed: nothing in the program may
// know a demo. A demo that is added to assets/demos is tested here without a line being written.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/claim/verdict.h"
#include "app/file/data.h"
#include "app/file/file.h"
#include "app/record/bodies.h"
#include "app/scene/demos.h"
#include "app/scene/scene.h"
#include "tests/app/run_hashes.h"
#include "tests/app/runs.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

void requireClaims(const Scene& scene, const Recording& recording) {
  REQUIRE_FALSE(recording.report.stopped);
  const Verdict verdict = judge(scene, recording);
  REQUIRE_FALSE(verdict.rows.empty());
  for (const ClaimRow& row : verdict.rows) {
    INFO(scene.name << ": " << row.label << ": measured " << row.measured << ", exact " << row.exact
                    << ", error " << row.error << ", allowed " << row.allowed);
    CHECK(row.holds());
  }
}

void requireClaims(const Scene& scene) {
  requireClaims(scene, record(scene, scene.image.rate));
}

// The hashes of a recorded run at a rate [1/s]; of a run anew, if the recording has other instants.
RunHashes recordedHashes(const Scene& scene, const Recording& recording, double rate) {
  const double every = recording.rate / rate;
  if (every < 1.0 || every != std::round(every)) return test::hashesOf(scene, rate);
  RunHashes hashes = hashesFor(scene, rate);
  for (std::size_t k = 0; k < recording.samples.size(); k += static_cast<std::size_t>(every))
    hashes.samples.push_back(hashOf(recording.samples[k]));
  addEvents(hashes, recording.report);
  return hashes;
}

// Where Eigen fuses operations itself, bits are not promised.
void requireBits([[maybe_unused]] const Scene& scene, [[maybe_unused]] const Recording& recording) {
#ifndef __FMA__
  const std::string file = dataFolder("golden") + "/hashes/" + scene.name + ".txt";
  const RunHashes expected = readHashes(readFile(file), file, scene);
  const RunHashes actual = recordedHashes(scene, recording, expected.rate);
  CHECK(firstDifference(expected, actual, scene).value_or("") == "");
#endif
}

std::set<std::string> materialsOf(const Scene& scene) {
  std::set<std::string> names;
  for (const BodyDef& body : scene.world.bodies)
    if (!body.material.empty()) names.insert(body.material);
  return names;
}

// "body.brick" for a body of its own, "array.ball.body" for the copies ball.0, ball.1, ….
std::string tableOf(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const bool copy = dot != std::string::npos &&
                    name.find_first_not_of("0123456789", dot + 1) == std::string::npos;
  return copy ? "array." + name.substr(0, dot) + ".body" : "body." + name;
}

constexpr std::size_t kMany = 40;  // bodies of a demo whose variations are left to the long tests

// --set for half the copies of each array that has more than ten: under another parameter fewer
// bodies must do.
std::vector<std::string> halved(const Scene& scene) {
  std::map<std::string, int> copies;
  for (const BodyDef& body : scene.world.bodies) ++copies[tableOf(body.name)];
  std::vector<std::string> overrides;
  for (const auto& [table, count] : copies)
    if (table.starts_with("array.") && count > 10)
      overrides.push_back(table.substr(0, table.rfind('.')) +
                          ".count=" + std::to_string(count / 2));
  return overrides;
}

std::string shapeText(const Shape& shape, double factor) {
  char text[320] = "";
  if (const Sphere* sphere = std::get_if<Sphere>(&shape))
    std::snprintf(text, sizeof text, "{ sphere = %.17g }", factor * sphere->r);
  if (const Box* box = std::get_if<Box>(&shape))
    std::snprintf(text, sizeof text, "{ box = [%.17g, %.17g, %.17g] }",
                  2.0 * factor * box->half.x(), 2.0 * factor * box->half.y(),
                  2.0 * factor * box->half.z());
  if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape))
    std::snprintf(text, sizeof text, "{ cylinder = [%.17g, %.17g] }", factor * cylinder->r,
                  factor * cylinder->h);
  if (const Capsule* capsule = std::get_if<Capsule>(&shape))
    std::snprintf(text, sizeof text, "{ capsule = [%.17g, %.17g] }", factor * capsule->r,
                  factor * capsule->h);
  if (const Ellipsoid* ellipsoid = std::get_if<Ellipsoid>(&shape))
    std::snprintf(text, sizeof text, "{ ellipsoid = [%.17g, %.17g, %.17g] }",
                  factor * ellipsoid->half.x(), factor * ellipsoid->half.y(),
                  factor * ellipsoid->half.z());
  if (const Hull* hull = std::get_if<Hull>(&shape)) {
    std::string points;
    for (const Vec3& p : hull->solid->points) {
      const Vec3 q = factor * (p - hull->origin);
      std::snprintf(text, sizeof text, "[%.17g, %.17g, %.17g]", q.x(), q.y(), q.z());
      points += (points.empty() ? "" : ", ") + std::string(text);
    }
    return "{ hull = [" + points + "] }";
  }
  if (const Compound* compound = std::get_if<Compound>(&shape)) {
    std::string parts;
    for (const Part& part : compound->parts) {
      const Vec3 x = factor * part.pose.x;
      const Quat& q = part.pose.q;
      std::string piece = shapeText(shapeOf(part), factor);
      piece.resize(piece.size() - 2);  // without its closing brace
      std::snprintf(text, sizeof text,
                    ", position = [%.17g, %.17g, %.17g], orientation = [%.17g, %.17g, %.17g, "
                    "%.17g] }",
                    x.x(), x.y(), x.z(), q.w(), q.x(), q.y(), q.z());
      parts += (parts.empty() ? "" : ", ") + piece + text;
    }
    return "{ compound = [" + parts + "] }";
  }
  return text;
}

// --set for every moving body that has a size.
std::vector<std::string> resized(const Scene& scene, double factor) {
  std::set<std::string> seen;
  std::vector<std::string> overrides;
  for (const BodyDef& body : scene.world.bodies) {
    if (!moves(body) || !seen.insert(tableOf(body.name)).second) continue;
    if (std::holds_alternative<Mesh>(body.shape)) continue;  // as large as its file says
    const std::string shape = shapeText(body.shape, factor);
    if (!shape.empty()) overrides.push_back(tableOf(body.name) + ".shape=" + shape);
  }
  return overrides;
}

// The whole start turned about the vertical.
void turn(WorldDef& world, double degrees) {
  const Quat q(Eigen::AngleAxisd(degrees * EIGEN_PI / 180.0, Vec3::UnitY()));
  world.gravity = q * world.gravity;
  for (BodyDef& body : world.bodies) {
    if (HalfSpace* plane = std::get_if<HalfSpace>(&body.shape)) {
      plane->n = q * plane->n;
    } else {
      body.position = q * body.position;
      if (!std::holds_alternative<Particle>(body.shape)) body.orientation = q * body.orientation;
    }
    body.velocity = q * body.velocity;
    body.angularVelocity = q * body.angularVelocity;
  }
  for (JointDef& joint : world.joints) {
    joint.anchorA = q * joint.anchorA;
    joint.anchorB = q * joint.anchorB;
    joint.axis = q * joint.axis;
  }
  for (Force& force : world.forces) {
    if (UniformWind* wind = std::get_if<UniformWind>(&force)) wind->force = q * wind->force;
    if (PointForce* point = std::get_if<PointForce>(&force)) point->force = q * point->force;
    if (CircularField* field = std::get_if<CircularField>(&force)) {
      field->centre = q * field->centre;
      field->rotation = q * field->rotation;
    }
    Spring* spring = std::get_if<Spring>(&force);
    if (spring && spring->a == kNoBody) spring->anchorA_B = q * spring->anchorA_B;
    if (spring && spring->b == kNoBody) spring->anchorB_B = q * spring->anchorB_B;
  }
}

enum class Copies { All, Half };

// The demos of a variation.
std::vector<std::string> namesFor(Copies copies) {
  std::vector<std::string> names = demoNames();
  if (copies == Copies::Half)
    std::erase_if(names, [](const auto& name) { return demo(name).world.bodies.size() > kMany; });
  return names;
}

// The overrides that a variation begins with.
std::vector<std::string> begin(const Scene& scene, Copies copies) {
  return copies == Copies::Half ? halved(scene) : std::vector<std::string>{};
}

// In numbers of its own a scene expects what comes of its gravity and size: how far a strand sinks,
// that dominoes stand on the floor from the start. What a few bodies expect holds for others, too.
void requireClaimsButOwn(Scene scene) {
  if (scene.world.bodies.size() > kMany) scene.expects.clear();
  requireClaims(scene);
}

void requireOtherGravity(Copies copies) {
  for (const std::string& name : namesFor(copies)) {
    Scene scene = demo(name, {"world.gravity=[0.0, -3.71, 0.0]"});
    // How much each way out of a solid adds to a fall is an experiment with that fall, no law.
    std::erase(scene.checks, "point-plans");
    requireClaimsButOwn(scene);
  }
}

void requireOtherRestitution(Copies copies) {
  for (const std::string& name : namesFor(copies)) {
    const Scene scene = demo(name);
    std::vector<std::string> overrides = begin(scene, copies);
    const std::set<std::string> materials = materialsOf(scene);
    if (materials.empty()) continue;  // its bodies say themselves what they are made of
    for (const std::string& material : materials)
      overrides.push_back("materials." + material + ".restitution=0.65");
    requireClaims(demo(name, overrides));
  }
}

void requireOtherDensity(Copies copies) {
  for (const std::string& name : namesFor(copies)) {
    const Scene scene = demo(name);
    std::vector<std::string> overrides = begin(scene, copies);
    for (const BodyDef& body : scene.world.bodies)
      if (moves(body) && body.density && !body.material.empty())
        overrides.push_back("materials." + body.material + ".density=777.0");
    requireClaims(demo(name, overrides));
  }
}

void requireOtherSize(Copies copies) {
  for (const std::string& name : namesFor(copies)) {
    const Scene scene = demo(name);
    std::vector<std::string> overrides = begin(scene, copies);
    for (const std::string& shape : resized(scene, 0.8)) overrides.push_back(shape);
    requireClaimsButOwn(demo(name, overrides));
  }
}

void requireTurned(Copies copies) {
  for (const std::string& name : namesFor(copies)) {
    Scene scene = demo(name, begin(demo(name), copies));
    turn(scene.world, 40.0);
    requireClaims(scene);
  }
}

}  // namespace

// Oracles: the closed forms of app/claim, with their own tolerances; the hashes of states, forces
// and events in golden/hashes. Two threads simulate here, one made the hashes.
TEST_CASE("every demo keeps its claims and has the bits of its hashes") {
  const test::ThreadsInUse two(2);
  for (const std::string& name : demoNames()) {
    CAPTURE(name);
    const Scene scene = demo(name);
    const Recording recording = record(scene, scene.image.rate);
    requireClaims(scene, recording);
    requireBits(scene, recording);
  }
}

TEST_CASE("every demo keeps its claims under another gravity") {
  requireOtherGravity(Copies::Half);
}

TEST_CASE("every demo keeps its claims with another restitution") {
  requireOtherRestitution(Copies::Half);
}

TEST_CASE("every demo keeps its claims with another density") {
  requireOtherDensity(Copies::Half);
}

TEST_CASE("every demo keeps its claims at another size") {
  requireOtherSize(Copies::Half);
}

TEST_CASE("every demo keeps its claims with its start turned by 40 degrees") {
  requireTurned(Copies::Half);
}

TEST_CASE("every demo keeps its claims under another gravity with all its bodies", "[long]") {
  requireOtherGravity(Copies::All);
}

TEST_CASE("every demo keeps its claims with another restitution and all its bodies", "[long]") {
  requireOtherRestitution(Copies::All);
}

TEST_CASE("every demo keeps its claims with another density and all its bodies", "[long]") {
  requireOtherDensity(Copies::All);
}

TEST_CASE("every demo keeps its claims at another size with all its bodies", "[long]") {
  requireOtherSize(Copies::All);
}

TEST_CASE("every demo keeps its claims turned by 40 degrees with all its bodies", "[long]") {
  requireTurned(Copies::All);
}

// Oracle: bit-equal rerun.
TEST_CASE("every demo writes the same trajectory twice, to its end", "[long]") {
  for (const std::string& name : demoNames()) {
    const Scene scene = demo(name);
    const Recording one = record(scene, 60.0), two = record(scene, 60.0);
    REQUIRE(one.samples.size() == two.samples.size());
    int differing = 0;
    for (std::size_t k = 0; k < one.samples.size(); ++k)
      for (std::size_t i = 0; i < one.samples[k].bodies.size(); ++i)
        if (one.samples[k].bodies[i].x != two.samples[k].bodies[i].x ||
            one.samples[k].bodies[i].q.coeffs() != two.samples[k].bodies[i].q.coeffs())
          ++differing;
    CAPTURE(name);
    CHECK(differing == 0);
  }
}

// Oracle: definition. What rests has left its last bit alone: some blocks of this heap are jammed
// so that velocities answer 40 times as much as the solver leaves.
TEST_CASE("the heap of pile comes to stand to the last bit") {
  Scene scene = demo("pile");
  scene.world.duration = 4.5;
  const Recording run = record(scene, 2.0);
  REQUIRE(run.samples.size() == 10);
  const Sample &before = run.samples[8], &after = run.samples[9];
  for (std::size_t i = 0; i < after.bodies.size(); ++i) {
    CAPTURE(scene.world.bodies[i].name);
    CHECK(after.bodies[i].x == before.bodies[i].x);
    CHECK(after.bodies[i].q.coeffs() == before.bodies[i].q.coeffs());
  }
}
