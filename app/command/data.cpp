#include "app/command/data.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "app/record/file.h"
#include "app/scene/findings.h"
#include "app/scene/scene.h"

namespace tumble {

namespace fs = std::filesystem;

namespace {

fs::path inSourceTree(std::string_view kind) {
  if (kind == "fonts") return TUMBLE_FONT_DIR;
  const fs::path source = TUMBLE_SOURCE_DIR;
  return kind == "golden" ? source / kind : source / "assets" / kind;
}

}  // namespace

std::string dataFolder(std::string_view kind) {
  std::vector<fs::path> tried;
  if (const char* data = std::getenv("TUMBLE_DATA"); data && *data) {
    tried = {fs::path(data) / kind};
  } else {
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    tried = {program.parent_path().parent_path() / "share" / "tumble" / kind, inSourceTree(kind)};
  }
  std::string places;
  for (const fs::path& place : tried) {
    std::error_code ignored;
    if (fs::is_directory(place, ignored)) return place.string();
    places += (places.empty() ? "'" : ", '") + place.string() + "'";
  }
  throw FileError("no folder of " + std::string(kind) + " at " + places +
                  "; set TUMBLE_DATA to the folder that holds it");
}

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
