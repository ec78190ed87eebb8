#include "app/file/data.h"

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "app/file/file.h"

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

}  // namespace tumble
