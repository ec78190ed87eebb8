// Text as coverage: Lato, with DejaVu Sans for the glyphs it lacks, rasterised by stb_truetype.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace tumble {

enum class Face { Regular, Bold, Italic };

/// A line of text as 8-bit coverage, and the same widened to a halo.
struct TextImage {
  int width = 0, height = 0;
  int left = 0, top = 0;  ///< [px] of the first pixel from the pen's start on the baseline; y down
  double advance = 0.0;   ///< [px] that the pen moved
  std::vector<std::uint8_t> ink, halo;
};

class Fonts {
 public:
  /// @param folder  with Lato-Regular.ttf, Lato-Bold.ttf, Lato-Italic.ttf and DejaVuSans.ttf
  /// @throws NoContext if a file is missing or is no font.
  explicit Fonts(const std::string& folder);
  ~Fonts();

  /// Text set on a baseline at a whole pixel, with kerning. The reference is valid until the next
  /// call.
  /// @param text  UTF-8; a byte sequence that is none is shown as U+FFFD
  /// @param size  [px] of the em
  /// @param halo  [px] by which the halo is wider than the ink
  const TextImage& set(std::string_view text, Face face, double size, double halo);

  /// Whether the glyph comes from a face itself, and not from the fallback.
  bool has(Face face, char32_t letter) const;
  /// Whether no face draws a box for it.
  bool knows(char32_t letter) const;

 private:
  struct Font;
  struct Glyph {
    const Font* font;
    int index;
  };
  struct Placed;
  Glyph find(Face face, char32_t letter) const;
  /// Advances and kerning; `pen` ends behind the last glyph [px].
  std::vector<Placed> layOut(std::string_view text, Face face, double size, double& pen) const;
  static void rasterise(const Placed& placed, TextImage& image);

  std::vector<std::unique_ptr<Font>> fonts_;  // by face, then the fallback
  std::map<std::tuple<std::string, Face, double, double>, TextImage> cache_;
};

/// UTF-8 to code points; a malformed byte gives U+FFFD.
std::u32string decodeUtf8(std::string_view text);

}  // namespace tumble
