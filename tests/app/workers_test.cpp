// Threads that worlds are lent: nothing of a run tells how many.
#include <atomic>
#include <stdexcept>

#include "app/record/threads.h"
#include "app/scene/demos.h"
#include "tests/app/run_hashes.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

RunHashes hashesBy(int threads, const Scene& scene) {
  const test::ThreadsInUse use(threads);
  return test::hashesOf(scene, scene.image.rate);
}

}  // namespace

TEST_CASE("workers do each item once, no worker two at once, and what one throws is thrown") {
  const Workers workers = makeWorkers(4);
  REQUIRE(workers.count == 4);
  std::vector<int> done(50), atWork(4);  // each worker's own
  std::atomic<bool> clashes = false;
  const auto act = [&](int item, int worker) {
    if (++atWork[worker] != 1) clashes = true;
    ++done[item];
    --atWork[worker];
  };
  for (int round = 0; round < 1000; ++round) workers.forEach(50, act);
  CHECK(done == std::vector<int>(50, 1000));
  CHECK_FALSE(clashes);
  const auto fails = [](int item, int) {
    if (item == 7) throw std::runtime_error("no");
  };
  CHECK_THROWS_AS(workers.forEach(50, fails), std::runtime_error);
  workers.forEach(50, act);
  CHECK(done == std::vector<int>(50, 1001));
  CHECK(makeWorkers(1).count == 1);
}

// Crowds in clusters, links with joints that share fixed bodies, and what bends.
TEST_CASE("a run has the same bits on one, two and eight threads") {
  const auto [name, duration] = GENERATE(table<const char*, const char*>(
      {{"brick-rain", "0.9"}, {"wall-and-ball", "0.3"}, {"links", "0.2"}, {"jello", "0.14"}}));
  CAPTURE(name);
  const Scene scene = readScene(scenePath(name), {std::string("world.duration=") + duration});
  const RunHashes alone = hashesBy(1, scene);
  for (const int threads : {2, 8}) {
    CAPTURE(threads);
    CHECK_FALSE(firstDifference(alone, hashesBy(threads, scene), scene));
  }
}
