// PNG files (PNG specification, §5, §10 and §11), read by stb_image, packed by libdeflate.
#include <libdeflate.h>
#include <stb_image.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "render/image.h"
#include "render/mask.h"

namespace tumble {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Level 1 costs a fifth of level 6 and is 20 % larger; unfiltered rows pack best on flat shading.
constexpr int kLevel = 1;
constexpr std::uint8_t kNoFilter = 0;

void appendBigEndian(Bytes& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

/// A chunk of type and data, with length before and CRC behind.
void appendChunk(Bytes& bytes, std::string_view type, std::span<const std::uint8_t> data) {
  appendBigEndian(bytes, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = bytes.size();
  bytes.insert(bytes.end(), type.begin(), type.end());
  bytes.insert(bytes.end(), data.begin(), data.end());
  appendBigEndian(bytes, libdeflate_crc32(0, &bytes[start], bytes.size() - start));
}

/// tEXt for plain ASCII, else iTXt, uncompressed and without a language. The CRC covers type and
/// data.
void appendText(Bytes& bytes, const std::string& key, const std::string& value) {
  if (key.empty() || key.size() > 79)
    throw std::invalid_argument("PNG text key of 1 to 79 letters: " + key);
  const bool ascii =
      std::all_of(value.begin(), value.end(), [](char c) { return (c & 0x80) == 0; });
  Bytes data(key.begin(), key.end());
  data.insert(data.end(), ascii ? 1 : 5, 0);
  data.insert(data.end(), value.begin(), value.end());
  appendChunk(bytes, ascii ? "tEXt" : "iTXt", data);
}

[[noreturn]] void refuse(const std::string& path, const std::string& what, int error) {
  throw std::runtime_error(path + ": " + what + ": " + std::strerror(error));
}

/// A file that disappears again unless it is kept.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& target)
      : target_(target), path_(target + ".part" + std::to_string(getpid())) {
    file_ = std::fopen(path_.c_str(), "wb");
    if (!file_) refuse(target_, "cannot be written", errno);
  }
  ~TemporaryFile() {
    if (file_) std::fclose(file_);
    if (!kept_) std::remove(path_.c_str());
  }
  void write(const Bytes& bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size())
      refuse(target_, "cannot be written", errno);
  }
  void keep() {
    const int closed = std::fclose(std::exchange(file_, nullptr));
    if (closed != 0) refuse(target_, "cannot be written", errno);
    if (std::rename(path_.c_str(), target_.c_str()) != 0)
      refuse(target_, "cannot be replaced", errno);
    kept_ = true;
  }

 private:
  std::string target_, path_;
  std::FILE* file_ = nullptr;
  bool kept_ = false;
};

Bytes readFile(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (!file) refuse(path, "cannot be read", errno);
  Bytes bytes;
  std::uint8_t block[65536];
  while (const std::size_t count = std::fread(block, 1, sizeof block, file.get()))
    bytes.insert(bytes.end(), block, block + count);
  if (std::ferror(file.get())) refuse(path, "cannot be read", errno);
  return bytes;
}

void writeWhole(const std::string& path, const Bytes& png) {
  TemporaryFile file(path);
  file.write(png);
  file.keep();
}

/// What a header says, and bytes a pixel.
struct Format {
  int width, height;
  std::uint8_t bits, colourType;
  std::size_t bytes;
};
constexpr std::uint8_t kGrey = 0, kTrueColour = 2, kTrueColourAlpha = 6;

/// Appends rows that each begin with their filter, as one zlib stream (§10.1).
void appendPixels(Bytes& png, const Format& format, const std::uint8_t* pixels) {
  // Kept from image to image: fresh memory, page by page, costs a quarter of the packing.
  thread_local Bytes rows, stream;
  const std::size_t row = format.bytes * static_cast<std::size_t>(format.width);
  rows.clear();
  rows.reserve((row + 1) * static_cast<std::size_t>(format.height));
  for (int y = 0; y < format.height; ++y, pixels += row) {
    rows.push_back(kNoFilter);
    rows.insert(rows.end(), pixels, pixels + row);
  }
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> packer(
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor);
  if (!packer) throw std::bad_alloc();
  stream.resize(libdeflate_zlib_compress_bound(packer.get(), rows.size()));
  const std::size_t size = libdeflate_zlib_compress(packer.get(), rows.data(), rows.size(),
                                                    stream.data(), stream.size());
  appendChunk(png, "IDAT", {stream.data(), size});
}

Bytes encode(const Format& format, const std::uint8_t* pixels,
             const std::map<std::string, std::string>& text) {
  Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'}, header;
  appendBigEndian(header, static_cast<std::uint32_t>(format.width));
  appendBigEndian(header, static_cast<std::uint32_t>(format.height));
  header.insert(header.end(), {format.bits, format.colourType, 0, 0, 0});
  appendChunk(png, "IHDR", header);
  for (const auto& [key, value] : text) appendText(png, key, value);
  appendPixels(png, format, pixels);
  appendChunk(png, "IEND", {});
  return png;
}

// Red, green, blue and alpha of each pixel.
Bytes withAlpha(const Image& image) {
  Bytes bytes;
  bytes.reserve(4 * image.alpha.size());
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    bytes.insert(bytes.end(), image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i),
                 image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    bytes.push_back(image.alpha[i]);
  }
  return bytes;
}

}  // namespace

std::vector<std::uint8_t> encodePng(const Image& image,
                                    const std::map<std::string, std::string>& text) {
  if (image.width <= 0 || image.height <= 0 ||
      image.rgb.size() != 3u * static_cast<std::size_t>(image.width) * image.height)
    throw std::invalid_argument("image of " + std::to_string(image.width) + " x " +
                                std::to_string(image.height) + " pixels holds " +
                                std::to_string(image.rgb.size()) + " bytes");
  if (image.alpha.empty())
    return encode({image.width, image.height, 8, kTrueColour, 3}, image.rgb.data(), text);
  return encode({image.width, image.height, 8, kTrueColourAlpha, 4}, withAlpha(image).data(), text);
}

void writePng(const std::string& path, const Image& image,
              const std::map<std::string, std::string>& text) {
  writeWhole(path, encodePng(image, text));
}

void writePng(const std::string& path, const GreyImage& image,
              const std::map<std::string, std::string>& text) {
  Bytes bytes;
  bytes.reserve(2 * image.grey.size());
  for (const std::uint16_t level : image.grey) {
    bytes.push_back(static_cast<std::uint8_t>(level >> 8));
    bytes.push_back(static_cast<std::uint8_t>(level & 255));
  }
  writeWhole(path, encode({image.width, image.height, 16, kGrey, 2}, bytes.data(), text));
}

Image readPng(const std::string& path) {
  const Bytes png = readFile(path);
  Image image;
  int channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(png.data(), static_cast<int>(png.size()), &image.width, &image.height,
                            &channels, 3),
      stbi_image_free);
  if (!pixels)
    throw std::runtime_error(path + ": is no PNG that can be read: " + stbi_failure_reason());
  image.rgb.assign(pixels.get(),
                   pixels.get() + 3u * static_cast<std::size_t>(image.width) * image.height);
  return image;
}

}  // namespace tumble
