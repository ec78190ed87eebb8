#include "app/scene/demos.h"

#include <algorithm>
#include <filesystem>

#include "app/file/data.h"
#include "app/file/file.h"
#include "app/scene/findings.h"

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
  // A slip may be one of a file's name: those in the same folder are as near as the demos.
  std::vector<std::string> near = names;
  const fs::path folder = fs::path(scene).parent_path();
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, ignored), end; entry != end;
       entry.increment(ignored))
    if (entry->path().extension() == ".toml")
      near.push_back((folder / entry->path().filename()).string());
  std::string nearest = nearestName(scene, near);
  if (nearest.empty()) nearest = nearestName(scene + ".toml", near);
  throw FileError(scene + ": neither a demo nor a file" +
                  (nearest.empty() ? "" : ", did you mean '" + nearest + "'?") +
                  " (`tumble list` names the demos)");
}

}  // namespace tumble
