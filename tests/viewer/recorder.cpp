// The window's recorder.
#include "app/viewer/recorder.h"

#include <chrono>

#include "tests/catch.h"

using namespace tumble;

namespace {

const std::string kScene = R"([world]
duration = 2.0
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[array]]
name = "box"
kind = "row"
count = 6
step = [0, 0.25, 0]
body = { shape = { box = [0.2, 0.2, 0.2] }, mass = 1.0, position = [0, 0.5, 0] }
)";

}  // namespace

// Oracle: the recording that is made at once.
TEST_CASE("a recording that grows ends as one that is made at once, to the bit") {
  const Scene scene = parseScene(kScene, "boxes");
  const Recording whole = record(scene, scene.image.rate);
  Recorder recorder(scene);
  recorder.waitFor(10.0);
  Recording grown;
  std::size_t before = 0;
  while (recorder.running() || grown.method.empty()) {
    if (!recorder.take(grown)) continue;
    CHECK(grown.samples.size() >= before);
    before = grown.samples.size();
  }
  recorder.take(grown);
  CHECK(recorder.complaint().empty());
  REQUIRE(grown.samples.size() == whole.samples.size());
  CHECK(grown.method == whole.method);
  CHECK(grown.report.certificate.steps == whole.report.certificate.steps);
  for (std::size_t k = 0; k < whole.samples.size(); ++k) {
    CHECK(grown.samples[k].t == whole.samples[k].t);
    for (std::size_t i = 0; i < whole.samples[k].bodies.size(); ++i)
      CHECK(grown.samples[k].bodies[i].x == whole.samples[k].bodies[i].x);
  }
}

TEST_CASE("a recorder that is no longer wanted ends between two samples") {
  const auto start = std::chrono::steady_clock::now();
  { const Recorder recorder(parseScene(kScene, "boxes", {"world.duration=10000"})); }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  CHECK(took.count() < 5.0);
}

TEST_CASE("a scene that cannot run leaves its complaint") {
  const Scene scene = parseScene(kScene, "boxes", {"array.box.step=[0, 0.1, 0]"});
  Recorder recorder(scene);
  while (recorder.running()) recorder.waitFor(0.1);
  CHECK(recorder.complaint().find("box.0") != std::string::npos);
}
