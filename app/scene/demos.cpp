#include "app/scene/demos.h"

#include <algorithm>
#include <filesystem>

#include "app/file/data.h"
#include "app/scene/findings.h"
#include "app/scene/scene.h"

namespace tumble {

namespace fs = std::filesystem;

std::vector<std::string> demoNames() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(dataFolder("demos")))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string scenePath(const std::string& scene) {
  const std::vector<std::string> names = demoNames();
  if (std::find(names.begin(), names.end(), scene) != names.end())
    return dataFolder("demos") + "/" + scene + ".toml";
  std::error_code ignored;
  if (fs::exists(scene, ignored)) return scene;
  throw SceneError(
      {{{scene},
        "neither a demo nor a file" + hint(scene, names) + " (`tumble list` names the demos)"}});
}

}  // namespace tumble
