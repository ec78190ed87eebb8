// tumble simulate: numbers only.
#include <fmt/core.h>

#include <optional>

#include "app/command/command.h"
#include "app/command/options.h"
#include "app/command/progress.h"
#include "app/command/run.h"
#include "app/export/scene_json.h"
#include "app/file/file.h"
#include "app/record/hashes.h"
#include "app/record/output.h"

namespace tumble {
namespace {

// Runs the scene, and writes its files and, if they are named, its hashes.
Recording runInto(const std::string& folder, bool nodes, const std::string& hashFile,
                  const Scene& scene, double rate, bool timed) {
  // The files are begun with the first sample: a scene that the world refuses makes none.
  std::optional<OutputFiles> files;
  RunHashes hashes = hashesFor(scene, rate > 0.0 ? rate : scene.image.rate);
  const auto write = [&](Sample&& sample) {
    if (!files) files.emplace(folder, scene, nodes);
    files->add(sample);
    if (!hashFile.empty()) hashes.samples.push_back(hashOf(sample));
  };
  Recording recording = runWithProgress(scene, rate, write, timed);
  if (!files) files.emplace(folder, scene, nodes);
  if (recording.end) files->add(*recording.end);
  files->finish(recording);
  writeFile(folder + "/scene.json", sceneJson(scene));
  if (!hashFile.empty()) {
    addEvents(hashes, recording.report);
    writeFile(hashFile, hashText(hashes));
  }
  return recording;
}

}  // namespace
}  // namespace tumble

namespace tumble::command {

int simulate(int argc, char** argv) {
  SceneOptions options;
  std::string folder, hashFile;
  double rate = 0.0;
  bool nodes = false, timed = false;
  CommandLine line(
      "simulate", "Runs a scene and writes its numbers.",
      {"path-of-brick                       # trajectory.csv, events.csv, "
       "contacts.csv, summary.json, scene.json",
       "my-scene.toml -o out/mine --rate 240 # 240 samples a second",
       "path-of-brick --set materials.brick.restitution=0.4",
       "pile --hash pile.txt                 # its bits, for `tumble verify` elsewhere"});
  addSceneOptions(line, options);
  line.option("-o,--output", folder, "folder for the files [out/<scene>]");
  addRate(line, rate);
  line.flag("--nodes", nodes, "nodes.csv too: places and velocities of the points of what bends");
  line.option("--hash", hashFile, "a file for the hash of each sample's bits", {.type = "FILE"});
  line.flag("--times", timed, "prints what `stepping` and the audit spend their time on");
  if (!line.read(argc, argv)) return kOk;

  const Scene scene = load(options);
  if (folder.empty()) folder = "out/" + scene.name;
  const Recording recording = runInto(folder, nodes, hashFile, scene, rate, timed);
  noteUnused(scene, recording.runs);
  printCertificate(recording);
  printTimes(recording);
  say("wrote " + folder + "/trajectory.csv, events.csv, contacts.csv, summary.json, scene.json" +
      (scene.world.joints.empty() ? "" : ", joints.csv") + (nodes ? ", nodes.csv" : ""));
  return exitOf(recording);
}

}  // namespace tumble::command
