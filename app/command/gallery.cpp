// tumble gallery: the key pictures of every demo, and a page to leaf through.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>

#include "app/command/command.h"
#include "app/command/gallery_page.h"
#include "app/command/letters.h"
#include "app/command/options.h"
#include "app/command/progress.h"
#include "app/command/run.h"
#include "app/command/shoot.h"
#include "app/command/sweeping.h"
#include "app/file/file.h"
#include "app/panel/page.h"
#include "app/present/instants.h"
#include "app/scene/demos.h"

namespace tumble::command {

namespace {

// Of the whole motion, where the still is taken unless the scene says so: on the way, with some of
// it still to come.
constexpr double kStillShare = 0.35;

struct Options {
  std::string folder = "out";
  bool all = false;
  std::vector<std::string> scenes, overrides;
};

// Two of one name would share a folder, and pictures of the later one pass for the other's.
void requireNamesApart(const std::vector<std::string>& scenes) {
  std::map<std::string, std::string> files;
  for (const std::string& scene : scenes) {
    const std::string file = scenePath(scene);
    const std::string name = std::filesystem::path(file).stem().string();
    const auto [other, isNew] = files.emplace(name, file);
    if (!isNew)
      throw UsageError(fmt::format("'{}' and '{}' would both be drawn into '{}'; rename one",
                                   other->second, file, name));
  }
}

// Draws one demo into folder/<name>; the worst exit code of its parts.
int exhibit(const Options& options, const std::string& asked, Studio& studio,
            std::vector<Exhibit>& exhibits) {
  Exhibit& shown = exhibits.emplace_back();
  shown.scene = load({asked, options.overrides});
  noteLackingLetters(shown.scene);
  const Scene& scene = shown.scene;
  const std::string& name = scene.name;
  makeFolder(options.folder);  // a scene that is refused, or given up meanwhile, leaves none
  say(name);
  std::fflush(stdout);
  const std::string folder = options.folder + "/" + name;
  Shoot shoot(scene, folder, studio);
  shoot.still(scene.image.still.value_or(kStillShare * scene.world.duration));
  shown.plates = {{name + "/still.png", "one instant"}};
  // What stays at rest looks the same at all times.
  if (tellingSamples(scene, shoot.recording(), 2).size() > 1) {
    shoot.strobe();
    shoot.sheet();
    shown.plates.insert(shown.plates.begin(), {name + "/strobe.png", "the whole motion"});
    shown.plates.push_back(
        {name + "/sheet.png", "instants, between which it moves by equal amounts"});
  }
  shoot.page(folder + "/page.html");
  writeFile(folder + "/" + name + ".toml", readFile(scene.file));
  shown.links = {{name + "/page.html", "play it"}, {name + "/" + name + ".toml", "scene"}};
  for (const auto& [plot, title] : plotNames(scene))
    shown.links.push_back({name + "/" + plot + ".csv", "numbers: " + title});
  const std::vector<std::string> panels = shoot.panels();
  for (std::size_t i = 0; i < panels.size(); ++i)
    shown.plates.push_back(
        i == 0 ? Plate{name + "/panels.png", "panels", true}
               : Plate{name + panels[i].substr(folder.size()), plotNames(scene)[i - 1].second});
  if (options.all) {
    std::vector<int> all(static_cast<std::size_t>(shoot.count()));
    std::iota(all.begin(), all.end(), 0);
    shoot.sequence(all);
    shoot.video(folder + "/film.mp4", {0, shoot.count()});
    shown.film = name + "/film.mp4";
  }
  shown.verdict = judge(scene, shoot.recording());
  int code = std::max(exitOf(shoot.recording()), shown.verdict.failed > 0 ? +kFailed : +kOk);
  if (scene.sweep) {
    code = std::max(code, runSweep(scene, folder, {0, 1}, studio).code);
    shown.plates.push_back({name + "/sweep.png", "for each " + scene.sweep->parameter, true});
  }
  return code;
}

}  // namespace

int gallery(int argc, char** argv) {
  Options options;
  CommandLine line(
      "gallery", "Draws demos and a page to leaf through them.",
      {"             # out/index.html with still, strobe, sheet and sweep of each demo",
       "arch slope   # these alone", "--all        # every sequence and film too; needs ffmpeg",
       "-o out/moon --set world.gravity=[0,-1.62,0]"});
  line.option("SCENE", options.scenes, "demos or TOML files [every demo]");
  line.option("-o,--output", options.folder, "folder for pages and pictures [out]");
  line.flag("--all", options.all, "every sequence and film too");
  addOverrides(line, options.overrides);
  if (!line.read(argc, argv)) return kOk;

  if (options.scenes.empty()) options.scenes = demoNames();
  requireNamesApart(options.scenes);
  Studio studio;
  studio.open();
  std::vector<Exhibit> exhibits;
  exhibits.reserve(options.scenes.size());  // scenes must stay where they are
  int code = kOk;
  for (const std::string& scene : options.scenes)
    code = std::max(code, exhibit(options, scene, studio, exhibits));
  writeFile(options.folder + "/index.html", galleryPage(exhibits));
  say(options.folder + "/index.html");
  return code;
}

}  // namespace tumble::command
