#include "render/page.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "render/targets.h"

namespace tumble {
namespace {

// The same as in page.glsl.
constexpr float kTop[3] = {235.0f, 239.0f, 244.0f}, kBottom[3] = {250.0f, 249.0f, 246.0f};

Image emptyPage(int width, int height) {
  Image page{width, height, {}, {}};
  const std::size_t bytes = 3u * static_cast<std::size_t>(width);
  page.rgb.resize(bytes * height);
  for (int y = 0; y < height; ++y) {
    const Colour colour = pageColour((y + 0.5) / height);
    std::uint8_t* row = page.rgb.data() + bytes * y;
    for (int c = 0; c < 3; ++c) row[c] = static_cast<std::uint8_t>(255.0f * colour[c] + 0.5f);
    for (std::size_t done = 3; done < bytes; done *= 2)
      std::memcpy(row + done, row, std::min(done, bytes - done));
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
    const std::uint8_t* from = layer.rgba + 4u * static_cast<std::size_t>(place.width) * row;
    const std::size_t y = static_cast<std::size_t>(page.height - 1 - place.y - row);
    std::uint8_t* to = page.rgb.data() + 3u * (y * page.width + place.x);
    for (int x = 0; x < place.width; ++x, from += 4, to += 3) {
      if (from[3] == 0) continue;
      const unsigned through = 255u - from[3];
      if (through == 0)
        std::copy_n(from, 3, to);
      else
        for (int c = 0; c < 3; ++c)
          to[c] = static_cast<std::uint8_t>(from[c] + div255(to[c] * through));
      if (page.alpha.empty()) continue;
      std::uint8_t& alpha = page.alpha[y * page.width + place.x + x];
      alpha = static_cast<std::uint8_t>(from[3] + div255(alpha * through));
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

Image composeFigure(int width, int height, const Layer& floor, const Layer& bodies) {
  Image figure{width, height, {}, {}};
  figure.alpha.resize(static_cast<std::size_t>(width) * height, 0);
  figure.rgb.resize(3 * figure.alpha.size(), 0);
  cover(figure, floor);
  cover(figure, bodies);
  return figure;
}

namespace {

// The means of 2 × 2 pixels of so many channels.
std::vector<std::uint8_t> halvedChannels(const std::vector<std::uint8_t>& all, int width,
                                         int height, int channels) {
  std::vector<std::uint8_t> half(static_cast<std::size_t>(channels) * (width / 2) * (height / 2));
  const std::size_t row = static_cast<std::size_t>(channels) * width;
  for (int y = 0; y < height / 2; ++y) {
    const std::uint8_t* from = all.data() + 2u * y * row;
    std::uint8_t* to = half.data() + static_cast<std::size_t>(y) * channels * (width / 2);
    for (int x = 0; x < width / 2; ++x, from += 2 * channels, to += channels)
      for (int c = 0; c < channels; ++c)
        to[c] = static_cast<std::uint8_t>(
            (from[c] + from[c + channels] + from[row + c] + from[row + c + channels] + 2) / 4);
  }
  return half;
}

}  // namespace

Image halved(const Image& image) {
  Image half{image.width / 2,
             image.height / 2,
             halvedChannels(image.rgb, image.width, image.height, 3),
             {}};
  if (!image.alpha.empty()) half.alpha = halvedChannels(image.alpha, image.width, image.height, 1);
  return half;
}

void straighten(Image& image) {
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    const unsigned alpha = image.alpha[i];
    if (alpha == 0 || alpha == 255) continue;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
      image.rgb[c] =
          static_cast<std::uint8_t>(std::min(255u, (255u * image.rgb[c] + alpha / 2) / alpha));
  }
}

}  // namespace tumble
