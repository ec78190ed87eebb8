// Images on disk: the same pixels back, text inside, and nothing half-written.
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "render/image.h"
#include "render/png_writer.h"
#include "tests/catch.h"
#include "tests/folder.h"

using namespace tumble;
using tumble::test::Folder;
namespace fs = std::filesystem;

namespace {

Image noise(int width, int height) {
  Image image{width, height, {}};
  std::uint32_t state = 1;
  for (int i = 0; i < 3 * width * height; ++i) {
    state = state * 1664525u + 1013904223u;
    image.rgb.push_back(static_cast<std::uint8_t>(state >> 24));
  }
  return image;
}

struct Chunk {
  std::string type, data;
  std::uint32_t crc;
};

std::uint32_t bigEndian(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 |
         std::uint32_t{bytes[at + 2]} << 8 | std::uint32_t{bytes[at + 3]};
}

std::vector<Chunk> chunks(const std::vector<std::uint8_t>& png) {
  std::vector<Chunk> result;
  for (std::size_t at = 8; at < png.size();) {
    const std::uint32_t size = bigEndian(png, at);
    REQUIRE(at + 12 + size <= png.size());
    const auto start = png.begin() + static_cast<std::ptrdiff_t>(at);
    result.push_back(
        {{start + 4, start + 8}, {start + 8, start + 8 + size}, bigEndian(png, at + 8 + size)});
    at += 12 + size;
  }
  return result;
}

/// CRC-32 bit by bit, from the PNG specification's definition.
std::uint32_t crc(const std::string& text) {
  std::uint32_t value = 0xffffffffu;
  for (const char letter : text) {
    value ^= static_cast<unsigned char>(letter);
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ (value & 1 ? 0xedb88320u : 0u);
  }
  return ~value;
}

}  // namespace

TEST_CASE("an image comes back from its PNG with every pixel") {
  const Folder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{7, 3}, std::pair{64, 48}}) {
    const Image image = noise(width, height);
    writePng(folder / "image.png", image);
    CHECK(readPng(folder / "image.png") == image);
  }
  CHECK(encodePng(noise(7, 3)) == encodePng(noise(7, 3)));
}

// Oracle: the PNG specification; CRCs by an independent computation.
TEST_CASE("text stands in chunks behind the header, as iTXt when it is not ASCII") {
  const std::vector<std::uint8_t> png =
      encodePng(noise(5, 5), {{"Scene", "brick e=0.8"}, {"Title", "ε = 0.8"}});
  const std::vector<Chunk> all = chunks(png);
  REQUIRE(all.size() >= 5);
  CHECK(all[0].type == "IHDR");
  CHECK(all[1].type == "tEXt");
  CHECK(all[1].data == std::string("Scene\0brick e=0.8", 17));
  CHECK(all[2].type == "iTXt");
  CHECK(all[2].data == std::string("Title\0\0\0\0\0", 10) + "ε = 0.8");
  CHECK(all.back().type == "IEND");
  for (const Chunk& chunk : all) CHECK(chunk.crc == crc(chunk.type + chunk.data));
}

TEST_CASE("a path below a regular file is refused with path and reason") {
  const Folder folder;
  std::ofstream(folder / "file") << "x";
  CHECK_THROWS_WITH(
      writePng(folder / "file/image.png", noise(4, 4)),
      Catch::Matchers::Contains("file/image.png") && Catch::Matchers::Contains("Not a directory"));
  CHECK_THROWS_WITH(readPng(folder / "none.png"), Catch::Matchers::Contains("none.png") &&
                                                      Catch::Matchers::Contains("No such file"));
  CHECK_THROWS_WITH(readPng(folder / "file"), Catch::Matchers::Contains("no PNG"));
}

TEST_CASE("a disk that fills up leaves the old image and no part of the new one") {
  const Folder folder;
  writePng(folder / "image.png", noise(8, 8));
  // A limit on file size stands in for the full disk; its signal is ignored, as a program must do.
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{4096, limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  try {
    writePng(folder / "image.png", noise(256, 256));
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, before);
  CHECK_THAT(message,
             Catch::Matchers::Contains("image.png") && Catch::Matchers::Contains("File too large"));
  CHECK(folder.files() == 1);
  CHECK(readPng(folder / "image.png") == noise(8, 8));
}

TEST_CASE("the writer's thread writes every image, and reports the first failure") {
  const Folder folder;
  {
    PngWriter writer(2);
    for (int i = 0; i < 12; ++i)
      writer.write(folder / (std::to_string(i) + ".png"), noise(16 + i, 16));
    writer.finish();
    CHECK(folder.files() == 12);
    CHECK(readPng(folder / "11.png") == noise(27, 16));
  }
  PngWriter writer;
  writer.write(folder / "0.png/below.png", noise(4, 4));
  CHECK_THROWS_WITH(writer.finish(), Catch::Matchers::Contains("0.png/below.png"));
  CHECK_THROWS(writer.write(folder / "later.png", noise(4, 4)));
}
