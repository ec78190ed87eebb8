#include "app/command/stamp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "app/file/data.h"
#include "app/file/digest.h"
#include "app/file/file.h"

namespace tumble {

namespace {

// What draws: the program's own file and the shaders that it reads.
std::string drawingProgram() {
  std::uint64_t hash = digest(readFile("/proc/self/exe"));
  std::vector<std::filesystem::path> shaders;
  for (const auto& entry : std::filesystem::directory_iterator(dataFolder("shaders")))
    shaders.push_back(entry.path());
  std::sort(shaders.begin(), shaders.end());
  for (const auto& shader : shaders) hash = digest(readFile(shader.string()), hash);
  return fmt::format("{:016x}", hash);
}

/// Chunks of a PNG from front to back (PNG specification, §5).
class Chunks {
 public:
  explicit Chunks(std::string_view file) : rest_(file) {
    constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
    const bool png = rest_.starts_with(kSignature);
    rest_.remove_prefix(png ? kSignature.size() : rest_.size());
  }

  /// Type and data of the next one; nothing at the end, or where the file breaks off.
  std::optional<std::pair<std::string_view, std::string_view>> next() {
    if (rest_.size() < 12) return {};
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(rest_[i]);
    if (rest_.size() - 12 < length) return {};
    const std::pair chunk(rest_.substr(4, 4), rest_.substr(8, length));
    rest_.remove_prefix(length + 12);
    return chunk;
  }

 private:
  std::string_view rest_;
};

}  // namespace

Stamp stampOf(const Scene& scene, const std::string& what) {
  static const std::string program = drawingProgram();
  std::error_code missing;
  const bool file = std::filesystem::is_regular_file(scene.file, missing);
  return {
      {"Software", "tumble " TUMBLE_VERSION},
      {"Program", program},
      {"Scene", scene.line},
      {"Source", fmt::format("{:016x}", file ? digest(readFile(scene.file)) : 0)},
      {"Image", fmt::format("{} {}x{} {} {} {} {:.17g} Hz, camera '{}'", what, scene.image.width,
                            scene.image.height, scene.image.antialias, scene.image.quality,
                            scene.image.transparent ? "transparent" : "page", scene.image.rate,
                            scene.camera.name)}};
}

Stamp readStamp(const std::string& path) {
  std::error_code missing;
  if (!std::filesystem::is_regular_file(path, missing)) return {};
  const std::string file = readFile(path);
  Stamp stamp;
  Chunks chunks(file);
  while (const auto chunk = chunks.next()) {
    const auto& [type, data] = *chunk;
    if (type == "IEND") return stamp;
    // A tEXt chunk has one zero between key and value; iTXt has four more bytes there.
    const std::size_t key = data.find('\0');
    const std::size_t gap = type == "tEXt" ? 1 : 5;
    if ((type == "tEXt" || type == "iTXt") && key != std::string_view::npos &&
        key + gap <= data.size())
      stamp[std::string(data.substr(0, key))] = data.substr(key + gap);
  }
  return {};
}

}  // namespace tumble
