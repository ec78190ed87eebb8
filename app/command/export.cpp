// tumble export: a run for other programs.
#include <fmt/core.h>

#include <filesystem>

#include "app/command/command.h"
#include "app/command/options.h"
#include "app/command/progress.h"
#include "app/command/run.h"
#include "app/export/gltf.h"
#include "app/export/scene_json.h"
#include "app/file/file.h"

namespace tumble::command {

int exportRun(int argc, char** argv) {
  SceneOptions options;
  std::string path;
  double rate = 0.0;
  CommandLine line("export", "Writes a run for other programs: glTF 2.0, or the scene resolved.",
                   {"pile -o pile.glb              # bodies and their motion, for any glTF viewer",
                    "pile -o pile.glb --rate 30    # half the key frames",
                    "my-scene.toml -o scene.json   # what its bodies are, without running it"});
  addSceneOptions(line, options);
  line.option("-o,--output", path, "FILE.glb or FILE.json [<scene>.glb]", {.type = "FILE"});
  addRate(line, rate);
  if (!line.read(argc, argv)) return kOk;

  const Scene scene = load(options);
  if (path.empty()) path = scene.name + ".glb";
  const std::filesystem::path file = path;
  if (file.extension() != ".glb" && file.extension() != ".json")
    throw UsageError(
        fmt::format("-o {}: expected a name that ends in .glb or .json; `tumble render` draws "
                    "images, pages and films",
                    path));
  prepareFile(path);
  if (file.extension() == ".json") {
    makeWorld(scene);
    writeFile(path, sceneJson(scene));
    say(path);
    return kOk;
  }
  const Recording recording = recordWithProgress(scene, rate);
  if (recording.samples.empty())
    throw StoppedError("the physics could not begin: " + recording.report.reason);
  writeFile(path, gltfBinary(scene, recording));
  say(path);
  return exitOf(recording);
}

}  // namespace tumble::command
