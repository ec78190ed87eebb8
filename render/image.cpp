#include "render/image.h"

#include <algorithm>
#include <cstdlib>

namespace tumble {

namespace {

// The paper of a row has the colour of the expected image's first pixel there.
bool isPaper(const Image& image, std::size_t pixel, const Image& expected) {
  const std::size_t row = 3 * static_cast<std::size_t>(expected.width);
  const std::uint8_t* paper = &expected.rgb[pixel - pixel % row];
  return std::equal(paper, paper + 3, &image.rgb[pixel]);
}

}  // namespace

ImageDifference compare(const Image& expected, const Image& actual) {
  ImageDifference difference;
  difference.sameSize = expected.width == actual.width && expected.height == actual.height;
  difference.exact = expected == actual;
  if (!difference.sameSize || difference.exact) return difference;

  std::int64_t sum = 0, off = 0, drawn = 0;
  for (std::size_t pixel = 0; pixel < expected.rgb.size(); pixel += 3) {
    drawn += !isPaper(expected, pixel, expected) || !isPaper(actual, pixel, expected);
    int worst = 0;
    for (std::size_t i = pixel; i < pixel + 3; ++i) {
      const int level = std::abs(int{expected.rgb[i]} - int{actual.rgb[i]});
      sum += level;
      worst = std::max(worst, level);
    }
    off += worst > 2;
    difference.largest = std::max(difference.largest, worst);
  }
  difference.mean = static_cast<double>(sum) / (3.0 * static_cast<double>(drawn));
  difference.share = 3.0 * static_cast<double>(off) / static_cast<double>(expected.rgb.size());
  return difference;
}

Image differenceImage(const Image& expected, const Image& actual) {
  Image image{std::max(expected.width, actual.width), std::max(expected.height, actual.height), {}};
  image.rgb.assign(static_cast<std::size_t>(image.width) * image.height * 3, 255);
  const int width = std::min(expected.width, actual.width);
  const int height = std::min(expected.height, actual.height);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < 3 * width; ++i) {
      const int a = expected.rgb[3u * y * expected.width + i];
      const int b = actual.rgb[3u * y * actual.width + i];
      image.rgb[3u * y * image.width + i] =
          static_cast<std::uint8_t>(std::min(255, 16 * std::abs(a - b)));
    }
  }
  return image;
}

}  // namespace tumble
