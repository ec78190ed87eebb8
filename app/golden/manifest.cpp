#include "app/golden/manifest.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/file/digest.h"
#include "app/file/file.h"

namespace tumble {

Manifest readManifest(const std::string& path) {
  Manifest manifest;
  if (!std::filesystem::exists(path)) return manifest;
  try {
    const nlohmann::json json = nlohmann::json::parse(readFile(path));
    json.at("gl_renderer").get_to(manifest.glRenderer);
    json.at("gl_version").get_to(manifest.glVersion);
    json.at("program").get_to(manifest.program);
    json.at("images").get_to(manifest.images);
  } catch (const nlohmann::json::exception& error) {
    throw FileError("'" + path + "' is no manifest of goldens: " + error.what());
  }
  return manifest;
}

void writeManifest(const std::string& path, const Manifest& manifest) {
  const nlohmann::ordered_json json = {{"gl_renderer", manifest.glRenderer},
                                       {"gl_version", manifest.glVersion},
                                       {"program", manifest.program},
                                       {"images", manifest.images}};
  writeFile(path, json.dump(2) + "\n");
}

namespace {

// Holds a folder for one process until it is gone.
class FolderLock {
 public:
  explicit FolderLock(const std::string& folder)
      : handle_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (handle_ < 0 || ::flock(handle_, LOCK_EX) != 0)
      throw FileError("cannot lock the folder '" + folder + "': " + std::strerror(errno));
  }
  ~FolderLock() { ::close(handle_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int handle_;
};

}  // namespace

void enterInManifest(const std::string& folder, const Manifest& now) {
  makeFolder(folder);
  const FolderLock lock(folder);
  const std::string path = folder + "/manifest.json";
  Manifest merged = readManifest(path);
  for (const auto& [subject, images] : now.images) merged.images[subject] = images;
  merged.glRenderer = now.glRenderer;
  merged.glVersion = now.glVersion;
  merged.program = now.program;
  writeManifest(path, merged);
}

std::string pixelHash(const Image& image) {
  std::string sides;  // four bytes each, the lowest first
  for (const int side : {image.width, image.height})
    for (int shift = 0; shift < 32; shift += 8) sides += static_cast<char>(side >> shift);
  const std::string_view pixels(reinterpret_cast<const char*>(image.rgb.data()), image.rgb.size());
  return fmt::format("{:016x}", digest(pixels, digest(sides)));
}

}  // namespace tumble
