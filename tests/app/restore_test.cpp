// A world that goes back to what it saved goes on to the same bits.
#include <set>

#include "app/present/bodies.h"
#include "app/record/hashes.h"
#include "app/scene/demos.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

/// Samples from one save to the next.
constexpr int kApart = 10;

/// A run to the end of its duration: its hashes and its certificate.
struct HashedRun {
  RunHashes hashes;
  Report report;
};

/// The run of a world that is at its start. With `returns` the world goes on at every tenth sample
/// for ten samples, and then back.
HashedRun hashedRun(World& world, const Scene& scene, bool returns) {
  HashedRun run{hashesFor(scene, scene.image.rate), {}};
  const int count = sampleCount(scene, scene.image.rate);
  const auto advanced = [&](int k) {
    const double t = static_cast<double>(k) / scene.image.rate;
    world.advance(t);
    return hashOf(world.sample(t));
  };
  for (int k = 0; k < count && !world.report().stopped; ++k) {
    const SampleHash here = advanced(k);
    if (world.report().stopped) break;
    run.hashes.samples.push_back(here);
    if (!returns || k == 0 || k % kApart != 0) continue;
    const SavedWorld saved = world.save();
    for (int later = k + 1; later <= k + kApart && later < count; ++later) advanced(later);
    world.restore(saved);
  }
  world.advance(scene.world.duration);
  run.report = world.report();
  addEvents(run.hashes, run.report);
  return run;
}

void requireSameCertificate(const Report& expected, const Report& actual) {
  CHECK(actual.stopped == expected.stopped);
  CHECK(actual.reason == expected.reason);
  CHECK(actual.notes == expected.notes);
  for (const auto& [key, number] : kCertificateFields) {
    CAPTURE(key);
    std::visit([&](auto field) { CHECK(actual.certificate.*field == expected.certificate.*field); },
               number);
  }
}

/// Bodies, or parts of them, up to which methods that are not the demo's own are asked too: to
/// follow every event of a heap exactly, or of a nut on its bolt, takes minutes.
constexpr int kFew = 8;
constexpr std::size_t kFewParts = 64;

std::size_t partsIn(const Scene& scene) {
  const World world = makeWorld(scene);
  std::size_t parts = 0;
  for (const Shape& shape : world.model().shapes)
    if (const Compound* compound = std::get_if<Compound>(&shape)) parts += compound->parts.size();
  return parts;
}

/// By its own method and, of few bodies, by every one that takes the scene.
void requireReturns(const std::string& name, const std::vector<std::string>& overrides) {
  std::set<std::string> methods = {""};
  for (const MethodName& method : methodNames()) methods.emplace(method.name);
  for (const std::string& method : methods) {
    std::vector<std::string> all = overrides;
    if (!method.empty()) all.push_back("world.method=\"" + method + "\"");
    CAPTURE(name, method);
    try {
      const Scene scene = readScene(scenePath(name), all);
      if (!method.empty() && method != "stepping" &&
          (movingCount(scene) > kFew || partsIn(scene) > kFewParts))
        continue;
      World world = makeWorld(scene);
      const SavedWorld start = world.save();
      const HashedRun expected = hashedRun(world, scene, false);
      world.restore(start);
      const HashedRun actual = hashedRun(world, scene, true);
      const auto difference = firstDifference(expected.hashes, actual.hashes, scene);
      CHECK(difference.value_or("") == "");
      requireSameCertificate(expected.report, actual.report);
    } catch (const SceneError&) {
      CHECK_FALSE(method.empty());  // its own method takes every demo
    }
  }
}

}  // namespace

// Oracle: the run that has not gone back yet; every bit of states, forces, events and certificate.
TEST_CASE(
    "a world that goes back to its start and at every tenth sample goes on to the same bits") {
  for (const std::string& name : demoNames()) requireReturns(name, {"world.duration=0.25"});
}

TEST_CASE("every demo, whole, goes back at every tenth sample and on to the same bits", "[long]") {
  for (const std::string& name : demoNames()) requireReturns(name, {});
}

TEST_CASE("what a world saved outlives what it does later, and no other world restores it") {
  const Scene scene = readScene(scenePath("card-house"));
  World world = makeWorld(scene), other = makeWorld(scene);
  world.advance(0.1);
  const std::uint64_t early = hashOf(world.sample(0.1)).state;
  const SavedWorld saved = world.save();
  for (int turn = 0; turn < 2; ++turn) {
    world.advance(1.0);
    CHECK(hashOf(world.sample(1.0)).state != early);
    world.restore(saved);
    CHECK(hashOf(world.sample(0.1)).state == early);
  }
  CHECK_THROWS_AS(other.restore(saved), std::invalid_argument);
  CHECK_THROWS_AS(world.restore(SavedWorld{}), std::invalid_argument);
}
