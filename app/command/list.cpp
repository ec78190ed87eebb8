// tumble list: the demos, by chapter.
#include <fmt/core.h>

#include <map>
#include <nlohmann/json.hpp>

#include "app/command/command.h"
#include "app/command/options.h"
#include "app/command/progress.h"
#include "app/scene/demos.h"

namespace tumble::command {

int list(int argc, char** argv) {
  CommandLine line("list", "The demos, by chapter.",
                   {"  # names, titles and claims", "-q # names alone"});
  bool json = false;
  line.flag("--json", json, "as JSON");
  if (!line.read(argc, argv)) return kOk;
  if (quiet() && !json) {
    for (const std::string& name : demoNames()) fmt::print("{}\n", name);
    return kOk;
  }

  std::map<std::string, std::vector<Scene>> chapters;
  for (const std::string& name : demoNames()) {
    Scene scene = load({name, {}});
    chapters[scene.chapter].push_back(std::move(scene));
  }
  if (json) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const auto& [chapter, scenes] : chapters)
      for (const Scene& scene : scenes)
        rows.push_back({{"name", scene.name},
                        {"chapter", chapter},
                        {"title", scene.title},
                        {"claim", scene.claim},
                        {"checks", scene.checks}});
    fmt::print("{}\n", rows.dump(2));
    return kOk;
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
