// tumble verify: a run held against the hashes of another, bit for bit.
#include <fmt/core.h>

#include "app/command/command.h"
#include "app/command/options.h"
#include "app/command/progress.h"
#include "app/command/run.h"
#include "app/file/file.h"
#include "app/record/hashes.h"

namespace tumble::command {

int verify(int argc, char** argv) {
  SceneOptions options;
  std::string path;
  CommandLine line("verify", "Runs a scene again and says where its bits part from their hashes.",
                   {"pile golden/hashes/pile.txt      # those that this version is held to",
                    "my-scene.toml mine.txt           # of `tumble simulate my-scene.toml --hash "
                    "mine.txt`, elsewhere or before"});
  addSceneOptions(line, options);
  line.option("HASHES", path, "file of hashes", {.required = true});
  if (!line.read(argc, argv)) return kOk;

  const Scene scene = load(options);
  const RunHashes expected = readHashes(readFile(path), path, scene);
  RunHashes actual = hashesFor(scene, expected.rate);
  const Recording recording = runWithProgress(
      scene, expected.rate, [&](Sample&& sample) { actual.samples.push_back(hashOf(sample)); });
  addEvents(actual, recording.report);
  if (const std::optional<std::string> difference = firstDifference(expected, actual, scene)) {
    fmt::print(stderr, "tumble: {} parts from {}: {}\n", scene.name, path, *difference);
    return kFailed;
  }
  say(fmt::format("{}: {} samples and {} events, the same bits", scene.name, actual.samples.size(),
                  actual.eventCount));
  return kOk;
}

}  // namespace tumble::command
