// tumble verify: a run held against the hashes of another, bit for bit.
#include <fmt/core.h>

#include <limits>

#include "app/command/command.h"
#include "app/command/options.h"
#include "app/command/progress.h"
#include "app/file/file.h"
#include "app/record/hashes.h"

namespace tumble::command {

namespace {

// The run at the instants of the samples expected; all of it and its events, or no further.
RunHashes runAsFar(const Scene& scene, const RunHashes& expected, bool whole) {
  Progress progress("simulating");
  RunHashes actual = hashesFor(scene, expected.rate);
  World world = makeWorld(scene);
  const std::size_t count =
      whole ? static_cast<std::size_t>(sampleCount(scene, expected.rate)) : expected.samples.size();
  for (std::size_t k = 0; k < count && !world.report().stopped; ++k) {
    const double t = static_cast<double>(k) / expected.rate;
    world.advance(t);
    if (!world.report().stopped) actual.samples.push_back(hashOf(world.sample(t)));
    progress.show(static_cast<double>(k + 1) / static_cast<double>(count));
  }
  if (!whole) {  // of the events of the whole run there is one hash
    actual.eventCount = expected.eventCount;
    actual.events = expected.events;
    return actual;
  }
  world.advance(scene.world.duration);
  addEvents(actual, world.report());
  return actual;
}

}  // namespace

int verify(int argc, char** argv) {
  SceneOptions options;
  std::string path;
  double until = std::numeric_limits<double>::infinity();  // s
  CommandLine line("verify", "Runs a scene again and says where its bits part from their hashes.",
                   {"pile golden/hashes/pile.txt      # those that this version is held to",
                    "my-scene.toml mine.txt           # of `tumble simulate my-scene.toml --hash "
                    "mine.txt`, elsewhere or before",
                    "pile golden/hashes/pile.txt --until 0.5   # of a build that is slow"});
  addSceneOptions(line, options);
  line.option("HASHES", path, "file of hashes", {.required = true});
  line.option("--until", until, "runs to this time and holds its samples alone [the whole run]",
              {.type = "S", .range = {{0.0, 1e9}}});
  if (!line.read(argc, argv)) return kOk;

  const Scene scene = load(options);
  RunHashes expected = readHashes(readFile(path), path, scene);
  const bool whole = !(until < scene.world.duration);
  if (!whole) std::erase_if(expected.samples, [&](const SampleHash& h) { return h.t > until; });
  const RunHashes actual = runAsFar(scene, expected, whole);
  if (const std::optional<std::string> difference = firstDifference(expected, actual, scene)) {
    tell(fmt::format("tumble: {} parts from {}: {}\n", scene.name, path, *difference));
    return kFailed;
  }
  say(whole ? fmt::format("{}: {} samples and {} events, the same bits", scene.name,
                          actual.samples.size(), actual.eventCount)
            : fmt::format("{}: {} samples to {:g} s, the same bits", scene.name,
                          actual.samples.size(), until));
  return kOk;
}

}  // namespace tumble::command
