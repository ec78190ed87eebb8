// Files that hold a scene, or none.
#include <filesystem>
#include <fstream>

#include "app/file/file.h"
#include "app/scene/scene.h"
#include "tests/catch.h"

namespace fs = std::filesystem;
using namespace tumble;

TEST_CASE("a file that cannot be read is told apart from one that is not there") {
  const fs::path folder = fs::path(TUMBLE_BINARY_DIR) / "scene-files";
  fs::create_directories(folder);
  const auto told = [](const fs::path& path) {
    try {
      readScene(path.string());
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(told(folder / "none.toml") == (folder / "none.toml").string() + ": there is no such file");
  CHECK(told(folder) ==
        folder.string() + ": is a folder; name a scene file, one that ends in .toml");
  CHECK_THROWS_AS(readScene((folder / "none.toml").string()), FileError);

  std::ofstream(folder / "huge.toml") << std::string((4 << 20) + 1, '\n');
  CHECK(told(folder / "huge.toml").find("larger than 4 MiB") != std::string::npos);

  std::ofstream(folder / "good.toml")
      << "[world]\n[[body]]\nname = \"ball\"\nshape = { sphere = 0.1 }\nmass = 1.0\n";
  CHECK(told(folder / "good.toml").empty());
  const Scene scene = readScene((folder / "good.toml").string());
  CHECK(scene.name == "good");
  CHECK(scene.file == (folder / "good.toml").string());
}
