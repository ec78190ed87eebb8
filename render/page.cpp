#include "render/page.h"

#include <cstddef>

namespace tumble {
namespace {

// The same as in page.glsl.
constexpr float kTop[3] = {235.0f, 239.0f, 244.0f}, kBottom[3] = {250.0f, 249.0f, 246.0f};

Image emptyPage(int width, int height) {
  Image page{width, height, {}};
  page.rgb.reserve(3u * static_cast<std::size_t>(width) * height);
  for (int y = 0; y < height; ++y) {
    const Colour colour = pageColour((y + 0.5) / height);
    std::uint8_t level[3];
    for (int c = 0; c < 3; ++c) level[c] = static_cast<std::uint8_t>(255.0f * colour[c] + 0.5f);
    for (int x = 0; x < width; ++x) page.rgb.insert(page.rgb.end(), level, level + 3);
  }
  return page;
}

/// v/255 to the nearest whole number, for v up to 255².
unsigned div255(unsigned v) {
  return (v + 128 + ((v + 128) >> 8)) >> 8;
}

void cover(Image& page, const Layer& layer) {
  const gl::Rectangle& place = layer.place;
  for (int row = 0; row < place.height; ++row) {
    const std::uint8_t* from = layer.rgba.data() + 4u * static_cast<std::size_t>(place.width) * row;
    const std::size_t y = static_cast<std::size_t>(page.height - 1 - place.y - row);
    std::uint8_t* to = page.rgb.data() + 3u * (y * page.width + place.x);
    for (int x = 0; x < place.width; ++x, from += 4, to += 3) {
      if (from[3] == 0) continue;
      const unsigned through = 255u - from[3];
      for (int c = 0; c < 3; ++c)
        to[c] = static_cast<std::uint8_t>(from[c] + div255(to[c] * through));
    }
  }
}

}  // namespace

Colour pageColour(double s) {
  const auto t = static_cast<float>(s);
  Colour colour;
  for (int c = 0; c < 3; ++c) colour[c] = (kTop[c] + t * (kBottom[c] - kTop[c])) / 255.0f;
  return colour;
}

Image composePage(int width, int height, const Layer& floor, const Layer& bodies) {
  Image page = emptyPage(width, height);
  cover(page, floor);
  cover(page, bodies);
  return page;
}

Image halved(const Image& image) {
  Image half{image.width / 2, image.height / 2, {}};
  half.rgb.resize(image.rgb.size() / 4);
  const std::size_t row = 3u * static_cast<std::size_t>(image.width);
  for (int y = 0; y < half.height; ++y) {
    const std::uint8_t* from = image.rgb.data() + 2u * y * row;
    std::uint8_t* to = half.rgb.data() + static_cast<std::size_t>(y) * (row / 2);
    for (int x = 0; x < half.width; ++x, from += 6, to += 3)
      for (int c = 0; c < 3; ++c)
        to[c] = static_cast<std::uint8_t>(
            (from[c] + from[c + 3] + from[row + c] + from[row + c + 3] + 2) / 4);
  }
  return half;
}

}  // namespace tumble
