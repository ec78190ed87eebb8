#include "app/golden/manifest.h"

#include <fmt/core.h>

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

std::string pixelHash(const Image& image) {
  std::string sides;  // four bytes each, the lowest first
  for (const int side : {image.width, image.height})
    for (int shift = 0; shift < 32; shift += 8) sides += static_cast<char>(side >> shift);
  const std::string_view pixels(reinterpret_cast<const char*>(image.rgb.data()), image.rgb.size());
  return fmt::format("{:016x}", digest(pixels, digest(sides)));
}

}  // namespace tumble
