#include "render/font.h"

#include <stb_truetype.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "render/context/context.h"

namespace tumble {
namespace {

constexpr const char* kFiles[] = {"Lato-Regular.ttf", "Lato-Bold.ttf", "Lato-Italic.ttf",
                                  "DejaVuSans.ttf"};
constexpr std::size_t kFallback = 3;

/// Glyphs start at quarters of a pixel.
constexpr double kShifts = 4.0;

/// Texts kept before the store is emptied: a film with a running clock must not fill the memory.
constexpr std::size_t kKept = 512;

/// The largest coverage within reach of each pixel, its outermost ring smoothed over one pixel.
std::vector<std::uint8_t> dilate(const std::vector<std::uint8_t>& ink, int width, int height,
                                 double reach) {
  struct Tap {
    int dx, dy;
    double weight;
  };
  std::vector<Tap> taps;
  const int far = static_cast<int>(std::ceil(reach));
  for (int dy = -far; dy <= far; ++dy) {
    for (int dx = -far; dx <= far; ++dx) {
      const double weight = std::min(1.0, reach + 0.5 - std::sqrt(double(dx * dx + dy * dy)));
      if (weight > 0.0) taps.push_back({dx, dy, weight});
    }
  }
  std::vector<std::uint8_t> halo(ink.size(), 0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int value = ink[static_cast<std::size_t>(y) * width + x];
      if (value == 0) continue;
      for (const Tap& tap : taps) {
        const int tx = x + tap.dx, ty = y + tap.dy;
        if (tx < 0 || ty < 0 || tx >= width || ty >= height) continue;
        std::uint8_t& to = halo[static_cast<std::size_t>(ty) * width + tx];
        to = std::max(to, static_cast<std::uint8_t>(value * tap.weight));
      }
    }
  }
  return halo;
}

}  // namespace

std::u32string decodeUtf8(std::string_view text) {
  std::u32string letters;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i++]);
    const int more = lead < 0x80       ? 0
                     : lead >> 5 == 6  ? 1
                     : lead >> 4 == 14 ? 2
                     : lead >> 3 == 30 ? 3
                                       : -1;
    char32_t letter = more <= 0 ? lead : lead & (0x3Fu >> more);
    bool good = more >= 0;
    for (int k = 0; good && k < more; ++k) {
      good = i < text.size() && (static_cast<unsigned char>(text[i]) >> 6) == 2;
      if (good) letter = letter << 6 | (static_cast<unsigned char>(text[i++]) & 0x3Fu);
    }
    letters.push_back(good ? letter : U'\uFFFD');
  }
  return letters;
}

struct Fonts::Font {
  std::vector<unsigned char> bytes;
  stbtt_fontinfo info{};
};

Fonts::Fonts(const std::string& folder) {
  for (const char* name : kFiles) {
    auto font = std::make_unique<Font>();
    std::ifstream file(folder + "/" + name, std::ios::binary);
    font->bytes.assign(std::istreambuf_iterator<char>(file), {});
    if (font->bytes.empty() || !stbtt_InitFont(&font->info, font->bytes.data(), 0))
      throw NoContext("font " + folder + "/" + name +
                      " cannot be read; install fonts-lato and fonts-dejavu-core");
    fonts_.push_back(std::move(font));
  }
}

Fonts::~Fonts() = default;

// Tabs and line breaks, which fonts draw a box for, are blanks.
Fonts::Glyph Fonts::find(Face face, char32_t letter) const {
  if (letter < U' ') letter = U' ';
  const Font* own = fonts_[static_cast<std::size_t>(face)].get();
  const Font* fallback = fonts_[kFallback].get();
  if (const int index = stbtt_FindGlyphIndex(&own->info, static_cast<int>(letter)))
    return {own, index};
  if (const int index = stbtt_FindGlyphIndex(&fallback->info, static_cast<int>(letter)))
    return {fallback, index};
  return {own, 0};
}

bool Fonts::has(Face face, char32_t letter) const {
  return stbtt_FindGlyphIndex(&fonts_[static_cast<std::size_t>(face)]->info,
                              static_cast<int>(letter)) != 0;
}

bool Fonts::knows(char32_t letter) const {
  for (const Face face : {Face::Regular, Face::Bold, Face::Italic})
    if (find(face, letter).index == 0) return false;
  return true;
}

/// A glyph at its place in a line; the box is its ink on the image [px].
struct Fonts::Placed {
  Glyph glyph;
  float scale, shift;  // pixels per font unit; of the pen beyond a whole pixel
  int x;               // whole pixel of the pen
  int x0, y0, x1, y1;
};

std::vector<Fonts::Placed> Fonts::layOut(std::string_view text, Face face, double size,
                                         double& pen) const {
  std::vector<Placed> line;
  Glyph before{nullptr, 0};
  pen = 0.0;
  for (const char32_t letter : decodeUtf8(text)) {
    const Glyph glyph = find(face, letter);
    const stbtt_fontinfo* info = &glyph.font->info;
    const float scale = stbtt_ScaleForMappingEmToPixels(info, static_cast<float>(size));
    // Kerning is known only between glyphs of one font.
    if (before.font == glyph.font)
      pen += scale * stbtt_GetGlyphKernAdvance(info, before.index, glyph.index);
    const double at = std::floor(pen * kShifts + 0.5) / kShifts;
    Placed placed{glyph,
                  scale,
                  static_cast<float>(at - std::floor(at)),
                  static_cast<int>(std::floor(at)),
                  0,
                  0,
                  0,
                  0};
    stbtt_GetGlyphBitmapBoxSubpixel(info, glyph.index, scale, scale, placed.shift, 0.0f, &placed.x0,
                                    &placed.y0, &placed.x1, &placed.y1);
    line.push_back(placed);
    int advance = 0, bearing = 0;
    stbtt_GetGlyphHMetrics(info, glyph.index, &advance, &bearing);
    pen += scale * advance;
    before = glyph;
  }
  return line;
}

/// Adds a glyph's ink; where glyphs meet, the darker one stays.
void Fonts::rasterise(const Placed& placed, TextImage& image) {
  const int width = placed.x1 - placed.x0, height = placed.y1 - placed.y0;
  if (width <= 0 || height <= 0) return;
  std::vector<unsigned char> box(static_cast<std::size_t>(width) * height, 0);
  stbtt_MakeGlyphBitmapSubpixel(&placed.glyph.font->info, box.data(), width, height, width,
                                placed.scale, placed.scale, placed.shift, 0.0f, placed.glyph.index);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t row = static_cast<std::size_t>(placed.y0 + y - image.top);
      std::uint8_t& to = image.ink[row * image.width + (placed.x + placed.x0 + x - image.left)];
      to = std::max(to, box[static_cast<std::size_t>(y) * width + x]);
    }
  }
}

const TextImage& Fonts::set(std::string_view text, Face face, double size, double halo) {
  const auto key = std::make_tuple(std::string(text), face, size, halo);
  if (const auto found = cache_.find(key); found != cache_.end()) return found->second;
  if (cache_.size() >= kKept) cache_.clear();

  // The box that holds all ink, with room for the halo around it.
  TextImage image;
  const std::vector<Placed> line = layOut(text, face, size, image.advance);
  int right = 0, bottom = 0;
  for (const Placed& placed : line) {
    image.left = std::min(image.left, placed.x + placed.x0);
    image.top = std::min(image.top, placed.y0);
    right = std::max(right, placed.x + placed.x1);
    bottom = std::max(bottom, placed.y1);
  }
  const int margin = static_cast<int>(std::ceil(halo)) + 1;
  image.left -= margin, image.top -= margin;
  image.width = right + margin - image.left;
  image.height = bottom + margin - image.top;

  image.ink.assign(static_cast<std::size_t>(image.width) * image.height, 0);
  for (const Placed& placed : line) rasterise(placed, image);
  image.halo = dilate(image.ink, image.width, image.height, halo);
  return cache_.emplace(key, std::move(image)).first->second;
}

}  // namespace tumble
