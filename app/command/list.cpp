// tumble list: the demos, by chapter.
#include <fmt/core.h>

#include <map>

#include "app/command/command.h"
#include "app/command/options.h"
#include "app/scene/demos.h"

namespace tumble::command {

int list(int argc, char** argv) {
  CommandLine line("list", "The demos, by chapter.", {"  # names, titles and claims"});
  if (!line.read(argc, argv)) return kOk;

  std::map<std::string, std::vector<Scene>> chapters;
  for (const std::string& name : demoNames()) {
    Scene scene = load({name, {}});
    chapters[scene.chapter].push_back(std::move(scene));
  }
  for (const auto& [chapter, scenes] : chapters) {
    fmt::print("{}\n", chapter.empty() ? "other" : chapter);
    for (const Scene& scene : scenes) {
      fmt::print("  {:<22}{}\n", scene.name, scene.title);
      if (!scene.claim.empty()) fmt::print("  {:<22}claim: {}\n", "", scene.claim);
    }
  }
  return kOk;
}

}  // namespace tumble::command
