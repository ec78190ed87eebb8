// tumble sweep: one run for each value of the scene's [sweep].
#include <fmt/format.h>

#include "app/command/command.h"
#include "app/command/letters.h"
#include "app/command/options.h"
#include "app/command/progress.h"
#include "app/command/run.h"
#include "app/command/sweeping.h"
#include "app/file/file.h"
#include "app/panel/variant_run.h"

namespace tumble::command {

int sweep(int argc, char** argv) {
  SceneOptions options;
  std::string folder, shard;
  CommandLine line(
      "sweep", "Runs a scene once for each value of its [sweep].",
      {"path-of-brick             # out/path-of-brick/sweep.csv, sweep.png, sweep-0/ …",
       "restitution-sweep --shard 2/8  # every eighth value from the third, no sheet",
       "path-of-brick --set sweep.values=[0.2,0.9]"});
  addSceneOptions(line, options);
  line.option("-o,--output", folder, "folder for the files [out/<scene>]");
  line.option("--shard", shard, "every N-th value from the I-th", {.type = "I/N"});
  if (!line.read(argc, argv)) return kOk;

  const std::pair<int, int> part = shard.empty() ? std::pair(0, 1) : parseShard(shard);
  const Scene scene = load(options);
  if (!scene.sweep)
    throw UsageError(fmt::format("{} has no [sweep] with parameter and values", scene.file));
  // A value that the scene or its method refuses is told before the first run.
  for (std::size_t k = part.first; k < scene.sweep->values.size(); k += part.second)
    makeWorld(sceneOf(scene, {"", {scene.sweep->setting(k)}, {}}));
  if (folder.empty()) folder = "out/" + scene.name;
  makeFolder(folder);

  noteLackingLetters(scene);
  Studio studio;
  studio.open();
  const SweepResult result = runSweep(scene, folder, part, studio);
  for (const std::string& path : result.files) say(path);
  if (result.failing > 0)
    tell(fmt::format("tumble: claims fail for {} of {} values of {}; the table says which\n",
                     result.failing, result.runs, scene.sweep->parameter));
  return result.code;
}

}  // namespace tumble::command
