// Pixels, and their way into PNG files and back.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tumble {

/// 8-bit sRGB, three bytes a pixel, rows from top to bottom.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  std::vector<std::uint8_t> alpha = {};  ///< a byte a pixel, not multiplied into the colours;
                                         ///< empty: all opaque
  bool operator==(const Image&) const = default;
};

/// PNG file bytes with the given text chunks (key → UTF-8 value). The same pixels give the same
/// bytes.
std::vector<std::uint8_t> encodePng(const Image& image,
                                    const std::map<std::string, std::string>& text = {});

/// Writes a PNG by way of a temporary file in the same folder that is renamed when complete.
/// @throws std::runtime_error with path and reason; nothing half-written is left.
void writePng(const std::string& path, const Image& image,
              const std::map<std::string, std::string>& text = {});

/// @throws std::runtime_error with path and reason.
Image readPng(const std::string& path);

/// How far two images are apart. What is drawn is every pixel that has another colour than the
/// paper, in either image; the paper of a row has the colour of the expected image's first pixel
/// there. An empty page thus hides no mistake that is all over a small body.
struct ImageDifference {
  bool sameSize = true;
  bool exact = true;
  double share = 0.0;  ///< share of pixels that differ by more than 2/255 in some channel
  double mean = 0.0;   ///< mean absolute difference over the channels of what is drawn, levels
  int largest = 0;     ///< largest difference, levels
  /// Exact, or at most 0.02 % of the pixels off by more than 2 levels and a mean of at most 0.004.
  bool passes() const { return sameSize && (exact || (share <= 2e-4 && mean <= 0.004)); }
};

ImageDifference compare(const Image& expected, const Image& actual);

/// |expected − actual| × 16 on black, for eyes.
Image differenceImage(const Image& expected, const Image& actual);

}  // namespace tumble
